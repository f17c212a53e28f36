#include "tools/ladder/rung.h"
#include "tools/limit/linear_program.h"

namespace voussoir::ladder {

const std::vector<Rung>& rungs() {
  static const std::vector<Rung> list = [] {
    std::vector<Rung> all = {
        contact_patch(),       //
        joint_stiffness(),     //
        intact_shortcut(),     //
        rigid_rotation(),      //
        free_spin(),           //
        axial_chain(),         //
        bending_cantilever(),  //
        ring_down(),           //
        bridge_ring(),         //
        maxwell_fit(),         //
        maxwell_ring(),        //
        softening_joint(),     //
        composite_joint(),     //
        falling_blocks(),      //
        colliding_blocks(),    //
        skew_arch(),           //
        fill_waves(),          //
        fill_triaxial(),       //
        fill_oedometer(),      //
        fill_footing(),        //
        fill_bearing(),        //
        fill_dispersal(),      //
        fill_patch(),          //
        fill_slide(),          //
        fill_rankine(),
    };
    if (limit::can_solve_linear_programs())
      for (const Rung& rung : {limit_analysis(), rings(), axle_strip()}) all.push_back(rung);
    return all;
  }();
  return list;
}

Finding within(std::string quantity, double expected, double got, double tolerance, std::string unit,
               std::string source) {
  Finding finding;
  finding.check.quantity = std::move(quantity);
  finding.check.unit = std::move(unit);
  finding.check.source = std::move(source);
  finding.check.expected = expected;
  finding.check.tolerance = tolerance;
  finding.check.absolute = true;
  finding.got = got;
  return finding;
}

Finding near(std::string quantity, double expected, double got, double share, std::string unit, std::string source) {
  Finding finding = within(std::move(quantity), expected, got, share, std::move(unit), std::move(source));
  finding.check.absolute = false;
  return finding;
}

Finding nothing(std::string quantity, double got, double tolerance, std::string unit, std::string source) {
  return within(std::move(quantity), 0.0, got, tolerance, std::move(unit), std::move(source));
}

Finding known_miss(Finding finding, std::string reason) {
  finding.check.miss = std::move(reason);
  return finding;
}

}  // namespace voussoir::ladder
