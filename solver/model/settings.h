// Settings of the solver from a case: plain data with the documented defaults, in SI units.
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
  double ratio = 0.02;                       // damping ratio; maxwell, rayleigh
  std::array<double, 2> band = {0.5, 12.0};  // Hz; maxwell, rayleigh (the two frequencies where the ratio is exact)
  int branches = 3;                          // maxwell
  double coefficient = 0.8;                  // local (Cundall): share of the out-of-balance force
};

/// Base acceleration on a uniform time grid. It is linear between the samples and zero before and after them.
struct GroundMotion {
  double dt = 0.0;                 // s
  std::vector<Vec3> acceleration;  // m/s2, world axes; the first sample is at t = 0
  double duration() const { return acceleration.empty() ? 0.0 : dt * double(acceleration.size() - 1); }
};

/// Fixed blocks that the solver moves relative to the ground without rotation, such as a settling support or a loading
/// plate. In a motion stage their motion may also differ from that of the ground, for example for a support on softer
/// soil or one that the waves reach later.
struct Drive {
  std::string group;                 // of the assembly; all its blocks are fixed
  Vec3 velocity = Vec3::Zero();      // m/s, constant from the first time step of the stage to the last
  Vec3 displacement = Vec3::Zero();  // m, over the stage, from rest to rest
  double factor = 1.0;               // factor on the motion of the ground; motion only
  double delay = 0.0;                // s, delay behind the motion of the ground; negative: earlier; motion only

  /// Displacement of the blocks (m) `time` (s) after the beginning of a stage of this duration (s). It follows the
  /// cycloid x = D (τ − sin 2πτ / 2π), whose velocity and acceleration are zero at both ends.
  Vec3 at(double time, double duration) const;
  bool with_ground() const { return factor == 1.0 && delay == 0.0; }
};

/// A dead load on a group of free blocks. It is distributed by mass over their centroids, or acts at a point of a
/// single block.
struct ForceLoad {
  std::string group;
  Vec3 force = Vec3::Zero();  // N, sum over the group
  std::optional<Vec3> at;     // m, in the reference placement; moves with the block
};

/// A pressure on a rectangle of the road, for example of a wheel, a sleeper or a crowd. The part beyond the ends of the
/// road does not act.
struct RoadLoad {
  RoadArea area;          // m, in plan
  double pressure = 0.0;  // N/m2 in plan, downwards
  std::string of;         // name of the load, for error messages
};

/// Loads on the free blocks and the fill in addition to gravity.
struct Loads {
  Vec3 acceleration = Vec3::Zero();  // m/s2, added to gravity
  std::vector<ForceLoad> forces;
  std::vector<RoadLoad> road;
};

/// Fixed blocks that can move along some axes or rotate about their centroids, such as a loading beam that stays level
/// or is hinged.
struct Guide {
  std::string group;                                 // of the assembly; all its blocks are fixed
  std::array<bool, 3> free = {false, false, false};  // along x, y, z
  bool turn = false;
};

/// Blocks that are moved as one rigid body to another position before a stage begins, and released there.
struct Placement {
  std::string group;         // of free blocks
  Vec3 move = Vec3::Zero();  // m
  double angle = 0.0;        // rad, about an axis; before the move
  Vec3 axis = Vec3::UnitY();
  Vec3 through = Vec3::Zero();  // m, a point of the axis, in the present placement
};

/// Search for the multiplier of a load pattern at which equilibrium is lost.
struct CollapseSettings {
  double to = 1.0;             // upper limit of the search; the lower limit is 0
  double tolerance = 1e-3;     // width of the bracket
  double displacement = 0.02;  // from which a motion is judged (MotionWatch), as a share of the median block size
  double confirm = 2.0;        // s: rise time of the load in the confirming dynamic runs; 0: no such runs
  std::optional<Vec3> tilt;    // axis about which gravity is rotated by the arc tangent of the multiplier, instead of
                               // loads
};

/// One construction step: the parts that it adds, or whose centering it strikes.
struct ConstructionStep {
  std::string label;                // for logs; if empty, made from the names
  std::vector<std::string> add;     // components ("arch"), components with their part ("arch 0"), groups, "fill"
  std::vector<std::string> strike;  // names of parts on centering, in the same form
  double below = 1e300;             // m: only named parts with their centroid below this height
  double lift = 0.0;                // m: largest height of a lift; 0: all at once
  bool centering = false;           // the added parts are held until their centering is struck
};

/// Construction sequence of a bridge: these steps or, if there are none, the usual order of masonry construction.
struct ConstructionSettings {
  std::vector<ConstructionStep> steps;
  double lift = 2.0;  // m, height of lifts in the usual order
};

/// Increments of a quasi-static stage (docs/theory/steps.md).
struct QuasiStaticSettings {
  int steps = 20;                    // number of increments over the whole path
  std::vector<double> path = {1.0};  // shares of the loads and drives at the corners of the path, which begins at 0
  std::optional<double> push;        // m: displacement of the loaded points along the loads at share 1, imposed by a
                                     // stiff testing machine
  int halvings = 4;                  // halvings of an increment without equilibrium before equilibrium counts as lost
};

/// A load that moves along the road.
struct MovingLoad {
  RoadLoad start;      // position at the beginning of the stage
  double speed = 0.0;  // m/s along x
};

struct StageSettings {
  enum class Kind { gravity, motion, free, collapse, quasi_static };
  enum class Method { automatic, newton, relaxation };  // gravity and quasi-static
  Kind kind = Kind::gravity;
  Method method = Method::automatic;
  bool allow_motion = false;                         // gravity: accept an equilibrium at any position of the stones
  std::optional<ConstructionSettings> construction;  // gravity, first stage only; none: the whole bridge is present at
                                                     // once
  double duration = 0.0;                             // s; motion and free; quasi-static: nominal time of its path in
                                                     // the results
  GroundMotion motion;                               // motion only: scaled, in m/s2
  std::vector<Drive> drives;                         // motion, free and quasi-static; no group twice
  std::vector<Placement> placements;                 // motion and free, from rest
  /// Loads at the end of the stage. They remain until another stage sets loads; none: the loads of the earlier stages
  /// remain. In a collapse stage: the load pattern that is multiplied.
  std::optional<Loads> loads;
  std::vector<MovingLoad> moving;    // motion, free and quasi-static; acts in addition to the earlier loads and instead
                                     // of `loads`
  CollapseSettings collapse;         // collapse only
  QuasiStaticSettings quasi_static;  // quasi-static only
  std::string label;                 // for logs: "gravity", "motion (pulse sine y)", …
  bool timed() const { return kind == Kind::motion || kind == Kind::free; }
};

struct ContactSettings {
  int points_per_side = 3;      // 3, 4 or 5: Gauss-Lobatto points of quadrilateral patches
  double gap_tolerance = 1e-4;  // m: faces closer than this start in contact
  double skin = 0.04;           // distance below which a contact is made, share of the median block size
  double reclip_slip = 0.05;    // slip past which a patch is clipped again, share of √(area of the patch)
  double reclip_angle = 0.05;   // rad, rotation past which a patch is clipped again
  bool search = true;           // search for contacts that appear during the run
};

struct StepSettings {
  double time_step = 0.0;  // s; 0: safety × critical time step
  double safety = 0.8;
  double mass_scaling_limit = 0.0;      // largest added share of mass (inertia only); 0: no mass scaling
  double mass_scaling_step = 0.0;       // s: required critical time step; 0: the largest within the limit
  double equilibrium_tolerance = 1e-6;  // out-of-balance force over the weight of an average block
  bool intact_shortcut = true;          // false: every patch is evaluated point by point (for verification)
};

/// Settings of `voussoir modal`.
struct ModalSettings {
  /// State of the joints: bonded and elastic, or as at equilibrium under gravity.
  enum class State { intact, gravity };
  int modes = 10;
  State state = State::intact;
  bool geometric = false;  // include the geometric stiffness of the joint forces
};

struct OutputSettings {
  double checkpoint_every = 5.0;   // s of simulated time
  double checkpoint_wall = 600.0;  // s of wall-clock time
  double fields_every = 0.5;       // s of simulated time; 0: only at the end of stages
  double history_every = 0.005;    // s of simulated time
  int gravity_modes = 3;           // number of periods of a bridge in the report of a gravity stage; 0: none
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
