// Readers of the sections of a case file. Private to io/case.
#pragma once
#include "io/case/case.h"
#include "io/toml/table_reader.h"

namespace voussoir {

void read_bridge(TableReader& root, Case& c);
void read_materials(TableReader& root, Case& c);
void read_joints(TableReader& root, Case& c);
void read_settings(TableReader& root, Case& c);  // analysis, contact, damping, output
void read_stages(TableReader& root, Case& c, CaseUse use);
void check_amounts(TableReader& root, const Case& c);  // numbers of time steps and files
void read_sensors(TableReader& root, Case& c);
void read_effects(TableReader& root, Case& c);
void read_modal(TableReader& root, Case& c);
void read_plots(TableReader& root, Case& c);
void read_limits(TableReader& root, Case& c);

/// Path of `name`, which is relative to the folder of the file `beside` unless it is absolute.
std::string relative_to(const std::string& beside, const std::string& name);
/// Name of the copy of a record in a run directory: motion_<stage>_<axis>.txt, stages count from 1.
std::string motion_file_name(std::size_t stage, int axis);

/// Name of the copy of a measured curve in a run directory, whose arguments count from 0.
std::string measured_file_name(std::size_t plot, std::size_t curve);

inline constexpr const char* axis_names[] = {"x", "y", "z"};

}  // namespace voussoir
