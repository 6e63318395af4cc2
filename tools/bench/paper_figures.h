#pragma once
// The columns of the paper's tables that benchmarks are compared with (Hsu and Keyser 2010, section 4.2).

#include <array>
#include <string_view>

namespace talus::paper {

/// A row of Table 1.
struct Example {
  std::string_view number;
  std::string_view scene;  // ours, without its dimension
  int frames;              // of the full simulation
  double speed_up;         // full over piling
  double error;            // relative error, mean over the simulation [%]
};

inline constexpr std::array<Example, 8> table_1 = {{
    {"1", "drop_in_a_pile", 1818, 6.0, 5.8},
    {"2", "varying_drops", 856, 2.1, 20.8},
    {"3", "multiple_piles", 2203, 3.7, 5.1},
    {"4a", "bunny_matrices_natural", 312, 1.2, 9.3},
    {"4b", "bunny_matrices_35", 312, 1.7, 16.0},
    {"4c", "bunny_matrices_45", 312, 1.8, 4.2},
    {"5", "drop_in_a_line", 928, 2.4, 9.6},
    {"6", "rings_in_a_box", 1061, 1.9, 9.9},
}};

/// A column of Table 2: the sleeping threshold in example 2.
struct Threshold {
  double tau;
  double speed_up;
};

inline constexpr std::array<Threshold, 5> table_2 = {{
    {0.7, 1.2},
    {0.6, 1.8},
    {0.5, 2.1},
    {0.4, 2.3},
    {0.3, 2.5},
}};

}  // namespace talus::paper
