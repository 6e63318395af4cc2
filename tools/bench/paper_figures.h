#pragma once
// The paper's own tables (Hsu and Keyser 2010, section 4.2).

#include <array>
#include <string_view>

namespace talus::paper {

/// A row of Table 1.
struct Example {
  std::string_view number;
  std::string_view scene;  // ours, without its dimension
  double angle;            // of repose [degrees]
  int frames;              // of the full simulation
  int objects;
  double full;      // [s]
  double piling;    // [s]
  double speed_up;  // full over piling
  double error;     // relative error, mean over the simulation [%]
};

inline constexpr std::array<Example, 8> table_1 = {{
    {"1", "drop_in_a_pile", 45, 1818, 400, 4125.4, 681.5, 6.0, 5.8},
    {"2", "varying_drops", 30, 856, 140, 495.2, 231.9, 2.1, 20.8},
    {"3", "multiple_piles", 45, 2203, 400, 5571.2, 1488.2, 3.7, 5.1},
    {"4a", "bunny_matrices_natural", 20, 312, 300, 596.1, 502.3, 1.2, 9.3},
    {"4b", "bunny_matrices_35", 35, 312, 300, 596.1, 359.4, 1.7, 16.0},
    {"4c", "bunny_matrices_45", 45, 312, 300, 596.1, 333.4, 1.8, 4.2},
    {"5", "drop_in_a_line", 45, 928, 400, 1461.6, 600.8, 2.4, 9.6},
    {"6", "rings_in_a_box", 60, 1061, 450, 4904.2, 2557.2, 1.9, 9.9},
}};

/// A column of Table 2: the sleeping threshold in example 2.
struct Threshold {
  double tau;
  double seconds;
  double speed_up;
};

inline constexpr double table_2_full = 495.2;  // [s]
inline constexpr std::array<Threshold, 5> table_2 = {{
    {0.7, 412.3, 1.2},
    {0.6, 269.8, 1.8},
    {0.5, 231.9, 2.1},
    {0.4, 215.6, 2.3},
    {0.3, 199.4, 2.5},
}};

}  // namespace talus::paper
