#pragma once
// Work that a step normally leaves out or does in a shorter way.

#include <array>

#include "common/params/field.h"

namespace talus {

/// Each option puts work back that a step leaves out since it would change nothing, or the path of the engine itself in
/// the place of a shorter one. A run gives the same bits with any of
/// them, but for `sweep_slow_bodies`. debug_fields says what each does.
struct DebugOptions {
  bool step_when_idle = false;
  bool keep_sleepers = false;
  bool recount_sleepers = false;
  bool gather_contacts = false;
  bool collide_in_flight = false;
  bool sweep_slow_bodies = false;
  bool bullet_islands = false;        // else sim3d/bullet/islands.h
  bool bullet_solver = false;         // else sim3d/bullet/rows.h
  bool bullet_row_order = false;      // else sim3d/bullet/row_system.h
  bool bullet_row_setup = false;      // else sim3d/bullet/row_setup.h
  bool bullet_compounds = false;      // else sim3d/bullet/placed_pieces.h
  bool visit_separate_pairs = false;  // else sim3d/bullet/idle_pairs.h
};

inline constexpr auto debug_fields = std::to_array<Field<DebugOptions>>({
    {&DebugOptions::step_when_idle,
     {.name = "step_when_idle",
      .meaning = "the engine steps while no body is awake: half a microsecond a step, in 2D a tenth more for each "
                 "thousand sleeping bodies"}},
    {&DebugOptions::keep_sleepers,
     {.name = "keep_sleepers",
      .meaning = "sleeping bodies stay in the lists that the engine walks, each as a body of its own; else Bullet's "
                 "lists have none of them, and 128 share a static body in Box2D. true: time in proportion to the "
                 "sleeping bodies"}},
    {&DebugOptions::recount_sleepers,
     {.name = "recount_sleepers",
      .meaning = "sleeping bodies are counted in each step. true: time in proportion to sleeping bodies and piles"}},
    {&DebugOptions::gather_contacts,
     {.name = "gather_contacts",
      .meaning = "contacts are gathered in each step, even if no policy or observer uses them. true: 5 to 15 % of a "
                 "run with `full`; `adaptive` uses them in each step anyway"}},
    {&DebugOptions::collide_in_flight,
     {.name = "collide_in_flight",
      .meaning =
          "Bullet only: collision of bodies in flight with the ground. true: a quarter of a microsecond for each "
          "in a step"}},
    {&DebugOptions::sweep_slow_bodies,
     {.name = "sweep_slow_bodies",
      .meaning =
          "continuous collision of slow bodies too. Slow is: in Bullet less than half the thinnest piece's width "
          "in a step, in Box2D, against sleeping bodies, less than a quarter. true: another run, in Box2D a "
          "tenth longer"}},
    {&DebugOptions::bullet_islands,
     {.name = "bullet_islands", .meaning = "Bullet only: Bullet's own sort of contacts by island"}},
    {&DebugOptions::bullet_solver,
     {.name = "bullet_solver", .meaning = "Bullet only: Bullet's own solver in the place of packed constraint rows"}},
    {&DebugOptions::bullet_row_order,
     {.name = "bullet_row_order",
      .meaning =
          "Bullet only: rows are solved in Bullet's order; else rows that share no body are solved side by side. "
          "No effect with `bullet_solver`"}},
    {&DebugOptions::bullet_row_setup,
     {.name = "bullet_row_setup",
      .meaning = "Bullet only: rows are made from Bullet's constraints; else from contact points. No effect with "
                 "`bullet_solver`"}},
    {&DebugOptions::bullet_compounds,
     {.name = "bullet_compounds",
      .meaning = "Bullet only: Bullet's own collision of compound shapes; else their pieces are placed once a step"}},
    {&DebugOptions::visit_separate_pairs,
     {.name = "visit_separate_pairs",
      .meaning = "Bullet only: visits to pairs of bodies without pieces near each other. No effect with "
                 "`bullet_compounds`"}},
});

}  // namespace talus
