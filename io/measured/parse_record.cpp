// Recordings: one CSV text each.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "io/measured/parts.h"
#include "io/measured/time_grid.h"
#include "io/measured/units.h"
#include "solver/base/counted.h"

namespace voussoir {

namespace {

constexpr double even = 1e-6;      // s, as for ground motion in io/records
constexpr int most_decimals = 17;  // of a number
constexpr std::size_t fewest_samples = 100;
constexpr double slow_sampling = 0.5;         // s; coarser steps show no mode of a masonry bridge
constexpr double large_acceleration = 100.0;  // m/s2

/// The contents of a text of numbers, row by row.
struct Samples {
  std::vector<double> times;  // s
  int decimals = 0;           // that the times are written with, at most
  std::vector<int> rows;      // in the file
  Eigen::MatrixXd values;     // samples × channels
};

[[noreturn]] void bad_cell(const CsvReader& csv, NumberTrouble trouble, std::string_view word,
                           const std::string& column) {
  csv.fail(explain(trouble, word, column) + "; fill the gap, cut the recording there, or leave the channel out");
}

/// The largest possible number of rows: a row has at least a digit and a separator for each column. So a damaged file
/// cannot use more memory than a few times its size.
std::size_t most_rows(std::string_view rest, std::size_t columns) {
  const auto lines = std::size_t(std::count(rest.begin(), rest.end(), '\n')) + 1;
  return std::min(lines, rest.size() / (2 * columns) + 1);
}

Samples read_samples(CsvReader& csv, std::size_t time_column) {
  const std::size_t columns = csv.columns().size(), most = most_rows(csv.rest(), columns);
  Samples samples;
  samples.times.reserve(most);
  samples.rows.reserve(most);
  samples.values.resize(Eigen::Index(most), Eigen::Index(columns) - 1);
  while (csv.next_row()) {
    const auto sample = Eigen::Index(samples.times.size());
    Eigen::Index channel = 0;
    for (std::size_t i = 0; i < columns; ++i) {
      const std::string_view cell = csv.need_cell(i);
      double value = 0.0;
      if (const NumberTrouble trouble = parse_number(cell, value); trouble != NumberTrouble::none)
        bad_cell(csv, trouble, cell, csv.columns()[i]);
      assert(sample < samples.values.rows());
      if (i == time_column) {
        samples.times.push_back(value);
        samples.decimals = std::max(samples.decimals, decimals_of(cell).value_or(most_decimals));
      } else {
        samples.values(sample, channel++) = value;
      }
    }
    csv.end_row();
    samples.rows.push_back(csv.row());
  }
  if (samples.values.rows() != Eigen::Index(samples.times.size()))
    samples.values.conservativeResize(Eigen::Index(samples.times.size()), Eigen::NoChange);
  return samples;
}

/// The first sample whose time step from the previous one is not `dt` within `slack` (s); 0: none.
std::size_t uneven_sample(const std::vector<double>& times, double dt, double slack = even) {
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(std::abs(times[i] - times[i - 1] - dt) <= slack)) return i;
  return 0;
}

double median_step(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

void check_steps(const CsvReader& csv, const Samples& samples, double mean) {
  const std::vector<double>& t = samples.times;
  const std::size_t against_mean = uneven_sample(t, mean);
  if (against_mean == 0) return;
  // A gap spoils the mean; the median leads to the gap itself, past steps that differ by the rounding of two times.
  const double usual = median_step(t), rounding = 1.5 * std::pow(10.0, -samples.decimals);
  std::size_t against_usual = uneven_sample(t, usual, std::max(even, rounding));
  if (against_usual == 0) against_usual = uneven_sample(t, usual);
  const std::size_t i = against_usual > 0 ? against_usual : against_mean;
  csv.fail(samples.rows[i], fmt::format("the time step is {:.9g} s here and {:.9g} s elsewhere. Time steps must be "
                                        "equal within {} s, or the times must agree with equal time steps within half "
                                        "of their last digit. Resample the recording, or cut it at a gap.",
                                        t[i] - t[i - 1], against_usual > 0 ? usual : mean, even));
}

/// Steps that are equal one by one may still change in the course of a long recording.
void check_drift(const CsvReader& csv, const Samples& samples, double dt) {
  const std::vector<double>& t = samples.times;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (const double expected = t[0] + dt * double(i); !(std::abs(t[i] - expected) <= std::max(even, 0.5 * dt)))
      csv.fail(
          samples.rows[i],
          fmt::format("the time is {:.9g} s. It must be {:.9g} s at equal time steps of {:.9g} s. The sampling rate "
                      "changes: resample the recording.",
                      t[i], expected, dt));
}

/// The step in s of times that must be even.
double time_step(const CsvReader& csv, const Samples& samples) {
  const std::vector<double>& t = samples.times;
  for (std::size_t i = 1; i < t.size(); ++i)
    if (!(t[i] > t[i - 1]))
      csv.fail(samples.rows[i],
               fmt::format("the time {} s follows {} s. Times must increase. Remove repeated rows and sort the rows.",
                           t[i], t[i - 1]));
  const double steps = double(t.size() - 1), mean = (t.back() - t[0]) / steps;
  if (uneven_sample(t, mean) > 0)
    if (const auto step = grid_step(t, 0.5 * std::pow(10.0, -samples.decimals))) return *step;
  check_steps(csv, samples, mean);
  check_drift(csv, samples, mean);
  // The first step is not rounded twice: what write_measured() wrote is read bit for bit.
  const double first = t[1] - t[0];
  return t[0] + first * steps == t.back() ? first : mean;
}

std::size_t time_column(const CsvReader& csv) {
  const auto& columns = csv.columns();
  const auto found = std::find(columns.begin(), columns.end(), "t");
  if (found == columns.end())
    csv.fail(csv.heading_row(),
             "there is no column 't'. Give the time in s in a column 't', and a column for each channel.");
  if (columns.size() < 2)
    csv.fail(csv.heading_row(), "there are no channels. Add a column for each sensor, or remove the file.");
  return std::size_t(found - columns.begin());
}

void check_channels(const CsvReader& csv, const std::vector<std::string>& channels,
                    const std::vector<MeasuredSensor>& sensors) {
  std::vector<std::string> known;
  for (const MeasuredSensor& s : sensors) known.push_back(s.id);
  known.insert(known.end(), base_channels.begin(), base_channels.end());
  std::vector<std::string> sorted = known;
  std::sort(sorted.begin(), sorted.end());
  for (const std::string& channel : channels)
    if (!std::binary_search(sorted.begin(), sorted.end(), channel))
      csv.fail(csv.heading_row(), fmt::format("channel '{}' is neither a sensor of sensors.csv nor the ground motion{}",
                                              shown(channel), short_suggestion(channel, known)));
}

/// Converts all channels into accelerations in m/s2. The ends that cannot be differentiated are cut off in all
/// channels.
void convert_units(Recording& record, const std::vector<MeasuredSensor>& sensors) {
  std::vector<const ChannelUnit*> units;
  int most = 0;
  for (const std::string& channel : record.channels) {
    const auto sensor =
        std::find_if(sensors.begin(), sensors.end(), [&](const MeasuredSensor& s) { return s.id == channel; });
    units.push_back(find_unit(sensor == sensors.end() ? "m/s2" : sensor->unit));
    most = std::max(most, units.back()->derivatives);
  }
  const Eigen::Index rows = std::max<Eigen::Index>(0, record.values.rows() - 2 * most * derivative_reach);
  Eigen::MatrixXd values(rows, record.values.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const ChannelUnit& unit = *units[std::size_t(c)];
    Eigen::VectorXd x = record.values.col(c);
    for (int i = 0; i < unit.derivatives; ++i) x = differentiated(x, record.dt);
    values.col(c) = x.segment((most - unit.derivatives) * derivative_reach, rows);
    if (unit.factor != 1.0) values.col(c) *= unit.factor;
  }
  record.values = std::move(values);
}

void remark_units(const Recording& record, std::vector<std::string>& remarks) {
  if (record.dt > slow_sampling)
    remarks.push_back(
        fmt::format("{}: the time step is {:.4g} s, which is too long for the modes of a bridge. 't' must be in s.",
                    record.name, record.dt));
  if (const double peak = record.values.cwiseAbs().maxCoeff(); peak > large_acceleration)
    remarks.push_back(
        fmt::format("{}: accelerations reach {:.4g} m/s2, so they are probably in another unit. They must be in m/s2, "
                    "or in the unit that a column 'unit' of sensors.csv gives.",
                    record.name, peak));
}

bool same_samples(const Recording& a, const Recording& b) {
  return a.channels == b.channels && a.values.rows() == b.values.rows() && a.values == b.values;
}

}  // namespace

void parse_record(const TextFile& file, Measured& measured) {
  CsvReader csv(file);
  const std::size_t time = time_column(csv);
  Recording record;
  record.name = file.name;
  for (std::size_t i = 0; i < csv.columns().size(); ++i)
    if (i != time) record.channels.push_back(csv.columns()[i]);
  if (!measured.sensors.empty()) check_channels(csv, record.channels, measured.sensors);
  Samples samples = read_samples(csv, time);
  if (samples.times.size() < fewest_samples)
    csv.fail(
        std::max(csv.row(), 1),
        fmt::format("the recording ends after {}. At least {} are needed. Give a longer recording, or remove the file.",
                    counted(samples.times.size(), "sample"), fewest_samples));
  record.dt = time_step(csv, samples);
  record.values = std::move(samples.values);
  const std::string place = fmt::format("{}:{}", file.name, csv.heading_row());
  for (MeasuredSensor& sensor : measured.sensors) sensor.named |= column_of(record, sensor.id) >= 0;
  drop_faulty(record, samples.rows, place, measured);
  if (record.channels.empty()) return measured.set_aside.push_back({place, "no channel of the recording is left"});
  convert_units(record, measured.sensors);
  if (std::size_t(record.values.rows()) < fewest_samples)
    csv.fail(std::max(csv.row(), 1),
             fmt::format("{} left after velocities and displacements were converted into accelerations. At least {} "
                         "are needed. Give a longer recording.",
                         counted(record.values.rows(), "sample is", "samples are"), fewest_samples));
  for (const Recording& other : measured.records)
    if (same_samples(other, record))
      return measured.set_aside.push_back({place, fmt::format("the same samples as {}", other.name)});
  remark_units(record, measured.remarks);
  measured.records.push_back(std::move(record));
}

}  // namespace voussoir
