// What a case asks of the solver, as plain data with the defaults of the documentation. Times in s, SI throughout.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry/polyhedron.h"
#include "geometry/road_area.h"

namespace voussoir {

struct DampingSettings {
  enum class Kind { none, maxwell, rayleigh, local };
  Kind kind = Kind::maxwell;
  double ratio = 0.02;                       // share of critical; maxwell, rayleigh
  std::array<double, 2> band = {0.5, 12.0};  // Hz; maxwell, rayleigh (the two frequencies where the ratio is exact)
  int branches = 3;                          // maxwell
  double coefficient = 0.8;                  // local (Cundall): share of the out-of-balance force
};

/// Base acceleration on a uniform time grid, linear in between, zero before and after.
struct GroundMotion {
  double dt = 0.0;                 // s
  std::vector<Vec3> acceleration;  // m/s2, world axes; the first sample is at t = 0
  double duration() const { return acceleration.empty() ? 0.0 : dt * double(acceleration.size() - 1); }
};

/// Fixed blocks that are moved without turning: a settling support, a loading plate. Relative to the ground. In a
/// motion stage they may also make another motion than the ground: a support on softer soil, or one that waves reach
/// later.
struct Drive {
  std::string group;                 // of the assembly; all its blocks are fixed
  Vec3 velocity = Vec3::Zero();      // m/s, constant from the stage's first step to its last
  Vec3 displacement = Vec3::Zero();  // m, over the stage, from rest to rest
  double factor = 1.0;               // share of the ground's motion that the blocks make; motion only
  double delay = 0.0;                // s, how much later than the ground; negative: earlier; motion only

  /// Where the blocks are `time` (s) after the beginning of a stage of this duration (s). The displacement follows
  /// the cycloid x = D (τ − sin 2πτ / 2π): velocity and acceleration vanish at both ends.
  Vec3 at(double time, double duration) const;
  bool with_ground() const { return factor == 1.0 && delay == 0.0; }
};

/// A dead force on a group of free blocks, shared by mass at their centroids, or at a point of a single block.
struct ForceLoad {
  std::string group;
  Vec3 force = Vec3::Zero();  // N, in all
  std::optional<Vec3> at;     // m, in the reference placement; moves with the block
};

/// A pressure on a rectangle of the road: a wheel, a sleeper, a crowd. What of it lies beyond the ends of the road does
/// not act.
struct RoadLoad {
  RoadArea area;          // m, in plan
  double pressure = 0.0;  // N/m2 in plan, downwards
  std::string of;         // what stands there, for errors
};

/// What acts on the free blocks and the fill beside gravity.
struct Loads {
  Vec3 acceleration = Vec3::Zero();  // m/s2, added to gravity
  std::vector<ForceLoad> forces;
  std::vector<RoadLoad> road;
};

/// Fixed blocks that are free to move along some axes, or to turn about their centroids: a loading beam that is kept
/// level, or is hinged.
struct Guide {
  std::string group;                                 // of the assembly; all its blocks are fixed
  std::array<bool, 3> free = {false, false, false};  // along x, y, z
  bool turn = false;
};

/// Blocks that are put somewhere else before a stage begins, as one rigid body: to be let go from there.
struct Placement {
  std::string group;         // of free blocks
  Vec3 move = Vec3::Zero();  // m
  double angle = 0.0;        // rad, about an axis; before the move
  Vec3 axis = Vec3::UnitY();
  Vec3 through = Vec3::Zero();  // m, a point of the axis in the present placement
};

/// How the multiplier of a load pattern is raised until equilibrium is lost.
struct CollapseSettings {
  double to = 1.0;             // the multiplier is looked for between 0 and this
  double tolerance = 1e-3;     // width of the bracket
  double displacement = 0.02;  // share of the median block size past which equilibrium is lost
  double confirm = 2.0;        // s: time in which the confirming dynamic runs raise the load; 0: none
  std::optional<Vec3> tilt;    // axis about which gravity is turned instead, by the arc tangent of the multiplier
};

/// One step of building a bridge: what is added, and what is let go.
struct ConstructionStep {
  std::string label;                // for logs; made of the names if empty
  std::vector<std::string> add;     // components ("arch"), components with their part ("arch 0"), groups, "fill"
  std::vector<std::string> strike;  // the same, of what stands on centering
  double below = 1e300;             // m: of what is named only what has its centroid below this height
  double lift = 0.0;                // m: laid in lifts of this height at most; 0: all at once
  bool centering = false;           // what is added is held until it is struck
};

/// How a bridge came to be: in these steps, or, without any, in the order in which masons build.
struct ConstructionSettings {
  std::vector<ConstructionStep> steps;
  double lift = 2.0;  // m, of the masons' order
};

/// How a quasi-static stage goes from equilibrium to equilibrium (docs/theory/steps.md).
struct QuasiStaticSettings {
  int steps = 20;                    // in which the whole path is gone
  std::vector<double> path = {1.0};  // shares of the loads and drives at its corners, one after the other from 0
  std::optional<double> push;        // m: a stiff machine pushes the loaded points as far along the loads at share 1
  int halvings = 4;                  // of a step that finds no equilibrium, before equilibrium counts as lost
};

/// A load that moves along the road.
struct MovingLoad {
  RoadLoad start;      // where it is when the stage begins
  double speed = 0.0;  // m/s along x
};

struct StageSettings {
  enum class Kind { gravity, motion, free, collapse, quasi_static };
  enum class Method { automatic, newton, relaxation };  // gravity and quasi-static
  Kind kind = Kind::gravity;
  Method method = Method::automatic;
  bool allow_motion = false;                         // gravity: an equilibrium is one wherever stones come to rest
  std::optional<ConstructionSettings> construction;  // gravity, of the first stage; none: all stands there at once
  double duration = 0.0;                             // s; motion and free; quasi-static: in which its path is drawn
  GroundMotion motion;                               // motion only: scaled, in m/s2
  std::vector<Drive> drives;                         // motion, free and quasi-static; no group twice
  std::vector<Placement> placements;                 // motion and free, from rest
  /// At the end of the stage and until another stage has some; none: as the stages before have left them. Of a collapse
  /// stage: the pattern that the multiplier multiplies.
  std::optional<Loads> loads;
  std::vector<MovingLoad> moving;    // motion, free and quasi-static, beside what acted before; instead of loads
  CollapseSettings collapse;         // collapse only
  QuasiStaticSettings quasi_static;  // quasi-static only
  std::string label;                 // for logs: "gravity", "motion (pulse sine y)", …
  bool timed() const { return kind == Kind::motion || kind == Kind::free; }
};

struct ContactSettings {
  int points_per_side = 3;      // 3, 4 or 5: Gauss-Lobatto points of quadrilateral patches
  double gap_tolerance = 1e-4;  // m: faces closer than this start in contact
  double skin = 0.04;           // neighbour list, share of the median block size
  double reclip_slip = 0.05;    // share of the patch size
  double reclip_angle = 0.05;   // rad
  bool search = true;           // look for contacts that appear during the run
};

struct StepSettings {
  double time_step = 0.0;  // s; 0: safety × critical
  double safety = 0.8;
  double mass_scaling_limit = 0.0;      // largest added share of mass (inertia only); 0: no mass scaling
  double mass_scaling_step = 0.0;       // s: critical step it aims for; 0: the largest within the limit
  double equilibrium_tolerance = 1e-6;  // out-of-balance force over the weight of an average block
  bool intact_shortcut = true;          // off: every patch takes the point-by-point path (verification)
};

/// What `voussoir modal` is asked for.
struct ModalSettings {
  /// Joints as if bonded and elastic; or as they are once the assembly rests under gravity.
  enum class State { intact, gravity };
  int modes = 10;
  State state = State::intact;
  bool geometric = false;  // with the stiffness of the forces that the joints carry
};

struct OutputSettings {
  double checkpoint_every = 5.0;   // s of simulated time
  double checkpoint_wall = 600.0;  // s of wall time
  double fields_every = 0.5;       // s of simulated time; 0: only at the end of stages
  double history_every = 0.005;    // s of simulated time
  int gravity_modes = 3;           // of a bridge: periods in the report of a gravity stage; 0: none
};

struct SolverSettings {
  Vec3 gravity = {0.0, 0.0, -9.81};  // m/s2
  DampingSettings damping;
  ContactSettings contact;
  StepSettings step;
  std::vector<Guide> guides;
  std::vector<StageSettings> stages;
  OutputSettings output;
  ModalSettings modal;
};

}  // namespace voussoir
