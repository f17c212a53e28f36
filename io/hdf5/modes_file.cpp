#include "io/hdf5/modes_file.h"

#include "io/hdf5/h5.h"

namespace voussoir {

namespace {

constexpr std::int64_t modes_format_version = 1;

/// One number of every mode.
template <class F>
std::vector<double> column(const std::vector<Mode>& modes, F number) {
  std::vector<double> values;
  for (const Mode& mode : modes) values.push_back(number(mode));
  return values;
}

std::vector<double> rows_of(const std::vector<Mode>& modes, Vec3 Mode::*row) {
  std::vector<double> values;
  for (const Mode& mode : modes) values.insert(values.end(), (mode.*row).data(), (mode.*row).data() + 3);
  return values;
}

void write_words(h5::File& h5, const std::vector<Mode>& modes) {
  std::vector<std::string> direction, detail;
  std::vector<std::int64_t> order;
  for (const Mode& mode : modes) {
    direction.push_back(mode.words.direction);
    detail.push_back(mode.words.detail);
    order.push_back(mode.words.order);
  }
  h5.set_texts("/modes", "direction", direction);
  h5.set_texts("/modes", "detail", detail);
  h5.write("modes/order", order);
}

std::vector<double> numbers_of(const std::vector<Vec3>& points) {
  std::vector<double> numbers;
  for (const Vec3& x : points) numbers.insert(numbers.end(), x.data(), x.data() + 3);
  return numbers;
}

void write_nodes(h5::File& h5, const ModesFile& file) {
  if (file.nodes.empty()) return;
  std::vector<double> shapes;
  for (const Mode& mode : file.modes)
    shapes.insert(shapes.end(), mode.nodes.data(), mode.nodes.data() + mode.nodes.size());
  h5.write("fill/nodes", numbers_of(file.nodes), {file.nodes.size(), 3}, "m");
  h5.write("modes/fill_shape", shapes, {file.modes.size(), file.nodes.size(), 3}, "1");
}

void read_nodes(const h5::File& h5, ModesFile& file) {
  if (!h5.has("fill/nodes")) return;
  const std::vector<double> places = h5.read<double>("fill/nodes", {h5::any, 3});
  const std::size_t nodes = places.size() / 3;
  const std::vector<double> shapes = h5.read<double>("modes/fill_shape", {file.modes.size(), nodes, 3});
  for (std::size_t i = 0; i < nodes; ++i) file.nodes.emplace_back(Vec3::Map(&places[3 * i]));
  for (std::size_t i = 0; i < file.modes.size(); ++i)
    file.modes[i].nodes = Eigen::Map<const NodeMotions>(&shapes[3 * nodes * i], Eigen::Index(nodes), 3);
}

}  // namespace

void write_modes(const std::string& path, const ModesFile& file) {
  const std::size_t n = file.modes.size(), blocks = file.places.centroid.size();
  h5::File h5 = h5::File::create(path);
  h5.set_text("/", "format", "voussoir-modes");
  h5.set_integer("/", "format_version", modes_format_version);
  h5.set_text("/", "units", "SI");
  h5.set_text("/", "program_version", VOUSSOIR_VERSION);
  h5.set_text("/", "about", file.about);
  h5.set_integer("/", "assembly_hash", std::int64_t(file.assembly_hash));
  h5.set_number("/", "mass", file.mass);
  h5.set_number("/", "block_size", file.places.size);
  h5.write("blocks/centroid", numbers_of(file.places.centroid), {blocks, 3}, "m");
  h5.write("blocks/mass", file.places.mass, {}, "kg");
  h5.write("modes/eigenvalue", column(file.modes, [](const Mode& m) { return m.eigenvalue; }), {}, "rad2/s2");
  h5.write("modes/frequency", column(file.modes, [](const Mode& m) { return m.frequency; }), {}, "Hz");
  h5.write("modes/modal_mass", column(file.modes, [](const Mode& m) { return m.modal_mass; }), {}, "kg");
  h5.write("modes/residual", column(file.modes, [](const Mode& m) { return m.residual; }), {}, "1");
  h5.write("modes/participation", rows_of(file.modes, &Mode::participation), {n, 3}, "1");
  h5.write("modes/effective_mass", rows_of(file.modes, &Mode::effective), {n, 3}, "kg");
  write_words(h5, file.modes);
  if (!file.damped.empty()) {
    std::vector<double> frequency, ratio;
    for (const DampedMode& mode : file.damped) frequency.push_back(mode.frequency), ratio.push_back(mode.ratio);
    h5.write("modes/damped_frequency", frequency, {}, "Hz");
    h5.write("modes/damping_ratio", ratio, {}, "1");
  }
  std::vector<double> shapes;
  for (const Mode& mode : file.modes)
    shapes.insert(shapes.end(), mode.shape.data(), mode.shape.data() + mode.shape.size());
  h5.write("modes/shape", shapes, {n, blocks, 6}, "1, 1/m");
  write_nodes(h5, file);
  h5.save();
}

ModesFile read_modes(const std::string& path) {
  const h5::File h5 = h5::File::open(path);
  h5::check_format(h5, "voussoir-modes", modes_format_version);
  ModesFile file;
  file.about = h5.text("/", "about");
  file.assembly_hash = std::uint64_t(h5.integer("/", "assembly_hash"));
  file.mass = h5.number("/", "mass");
  file.places.size = h5.number("/", "block_size");
  file.places.mass = h5.read<double>("blocks/mass");
  const std::size_t blocks = file.places.mass.size();
  const std::vector<double> centroids = h5.read<double>("blocks/centroid", {blocks, 3});
  for (std::size_t i = 0; i < blocks; ++i) file.places.centroid.emplace_back(Vec3::Map(&centroids[3 * i]));
  const std::vector<double> eigenvalue = h5.read<double>("modes/eigenvalue");
  const std::size_t n = eigenvalue.size();
  const auto numbers = [&](const char* name) { return h5.read<double>(std::string("modes/") + name, {n}); };
  const auto triples = [&](const char* name) { return h5.read<double>(std::string("modes/") + name, {n, 3}); };
  const std::vector<double> frequency = numbers("frequency"), mass = numbers("modal_mass"),
                            residual = numbers("residual"), participation = triples("participation"),
                            effective = triples("effective_mass"),
                            shapes = h5.read<double>("modes/shape", {n, blocks, 6});
  const std::vector<std::int64_t> order = h5.read<std::int64_t>("modes/order", {n});
  const std::vector<std::string> direction = h5.texts("/modes", "direction"), detail = h5.texts("/modes", "detail");
  if (direction.size() != n || detail.size() != n)
    h5.fail("modes", "its attributes direction and detail do not name every mode");
  for (std::size_t i = 0; i < n; ++i) {
    Mode mode;
    mode.eigenvalue = eigenvalue[i], mode.frequency = frequency[i];
    mode.modal_mass = mass[i], mode.residual = residual[i];
    mode.participation = Vec3::Map(&participation[3 * i]);
    mode.effective = Vec3::Map(&effective[3 * i]);
    mode.words = {direction[i], int(order[i]), detail[i]};
    mode.shape = Eigen::Map<const BlockMotions>(&shapes[6 * blocks * i], Eigen::Index(blocks), 6);
    file.modes.push_back(std::move(mode));
  }
  read_nodes(h5, file);
  if (!h5.has("modes/damped_frequency")) return file;
  const std::vector<double> damped = numbers("damped_frequency"), ratio = numbers("damping_ratio");
  for (std::size_t i = 0; i < n; ++i) file.damped.push_back({damped[i], ratio[i]});
  return file;
}

}  // namespace voussoir
