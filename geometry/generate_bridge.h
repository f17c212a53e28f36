// The generator "bridge" in three files: its keys, what they mean, and what is built.
#pragma once
#include "geometry/generator.h"
#include "geometry/masonry_parts.h"

namespace voussoir {

constexpr std::size_t most_spans = 60;

std::vector<Parameter> any_bridge_keys();
std::vector<Choice> any_bridge_choices();
std::vector<KeyTable> any_bridge_tables();

/// Throws InputError for what cannot be, with the keys of the entry.
Bridge read_any_bridge(const GeneratorInput& in);
/// Where the keys of a span and of a support are: "span.1.", "pier.1." (one entry holds for all), "abutment.left.".
std::string span_prefix(std::size_t span);
std::string support_prefix(const GeneratorInput& in, std::size_t support, std::size_t spans);
/// How errors name a support: "[bridge.abutment.left]", "[[bridge.pier]] number 1".
std::string support_heading(std::size_t support, std::size_t spans);
/// The lowest point of the backing's top from x0 to x1, z.
double least_backing(const Bridge& bridge, double x0, double x1);

}  // namespace voussoir
