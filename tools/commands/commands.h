#pragma once
// The sub-commands of `talus`. Each adds itself to the command line and sets `exit_code` (exit_codes of
// tools/output/output.h) when it has run.

#include <CLI/CLI.hpp>

#include "tools/commands/validators.h"
#include "tools/output/output.h"

namespace talus {

void add_run_command(CLI::App& app, int& exit_code);
void add_list_command(CLI::App& app, int& exit_code);
void add_check_command(CLI::App& app, int& exit_code);
void add_reference_command(CLI::App& app, int& exit_code);
void add_new_command(CLI::App& app, int& exit_code);
void add_bench_command(CLI::App& app, int& exit_code);
void add_stress_command(CLI::App& app, int& exit_code);
void add_sweep_command(CLI::App& app, int& exit_code);

// Where talus is built with Bullet, whose libraries cut meshes into convex parts.
void add_decompose_command(CLI::App& app, int& exit_code);

// On the messages of runs; where talus is built with LCM.
void add_view_command(CLI::App& app, int& exit_code);
void add_compare_command(CLI::App& app, int& exit_code);
void add_export_command(CLI::App& app, int& exit_code);
void add_film_command(CLI::App& app, int& exit_code);
void add_info_command(CLI::App& app, int& exit_code);
void add_monitor_command(CLI::App& app, int& exit_code);
void add_replay_command(CLI::App& app, int& exit_code);

}  // namespace talus
