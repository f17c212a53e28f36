// First pass of a step: every patch reads its two bodies, updates its own memory and stores one wrench in its own slot.
#pragma once
#include "solver/contact/jump.h"

namespace voussoir {

constexpr int wrench_width = 8;  // force 3, moment about the world's origin 3, unused: one cache line a patch

/// What the pass found, gathered by each thread for itself and merged without regard to order.
struct PassReport {
  bool reclip = false;      // some patch has slid or turned past its limit
  std::int64_t intact = 0;  // patches on the intact path
  std::int64_t points = 0;  // patches computed point by point
  void merge(const PassReport& other) {
    reclip |= other.reclip;
    intact += other.intact;
    points += other.points;
  }
};

struct PatchPass {
  const Model* model = nullptr;
  State* state = nullptr;
  Branches branches;
  double* wrenches = nullptr;  // wrench_width × (joints, then contacts)
  bool shortcut = true;        // false: every patch point by point, for verification

  /// Batches [begin, end) of joints: intact lanes as generalised springs, the others point by point, eight side by
  /// side.
  PassReport batches(std::size_t begin, std::size_t end) const;
  /// Contacts [begin, end).
  PassReport contacts(std::size_t begin, std::size_t end) const;
};

/// A joint leaves the intact path: its rigid slip field and affine branch field are handed to its points.
void joint_to_points(const Model& model, State& state, const Branches& branches, std::size_t index);

/// One patch of `memory` point by point; returns true when it has slid or turned past the limits of clipping anew.
bool point_patch(const Model& model, const Patch& patch, std::size_t index, const Array<double>& points,
                 const double* pose, const Branches& branches, PatchMemory& memory, double* wrench);

}  // namespace voussoir
