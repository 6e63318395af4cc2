#pragma once

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace talus {

/// The error of a folder that holds something else than `job`, which is as "the same sweep of the same scene".
std::invalid_argument other_job(const std::filesystem::path& folder, std::string_view job);

/// Makes the folder of a job that the file `own` in it describes. Throws other_job() where it holds anything else.
void make_job_folder(const std::filesystem::path& folder, std::string_view own, std::string_view job);

}  // namespace talus
