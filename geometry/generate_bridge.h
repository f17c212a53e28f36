// The generator "bridge" in three files: its keys, the dimensions that follow from them, and the assembly.
#pragma once
#include "geometry/generator.h"
#include "geometry/masonry_parts.h"

namespace voussoir {

constexpr std::size_t most_spans = 60;

std::vector<Parameter> any_bridge_keys();
std::vector<Choice> any_bridge_choices();
std::vector<KeyTable> any_bridge_tables();

/// The dimensions of a bridge. Throws InputError for impossible dimensions, with the keys of the entry.
Bridge read_any_bridge(const GeneratorInput& in);
/// The beginnings of the keys of a span and of a support: "span.1.", "pier.1." (one entry for all), "abutment.left.".
std::string span_prefix(std::size_t span);
std::string support_prefix(const GeneratorInput& in, std::size_t support, std::size_t spans);
/// The name of a support in errors: "[bridge.abutment.left]", "[[bridge.pier]] number 1".
std::string support_heading(std::size_t support, std::size_t spans);
/// The lowest z of the top of the backing between x0 and x1.
double least_backing(const Bridge& bridge, double x0, double x1);

}  // namespace voussoir
