// Time series of a run: named channels, readable at any moment while the run goes on.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace voussoir {

/// One column of a history; `path` is its dataset in the file, e.g. "energy/kinetic".
struct Channel {
  std::string path;
  std::string unit;
  bool operator==(const Channel&) const = default;
};

/// Rows in memory, and on disk after flush(): every dataset is one-dimensional with one value a row.
class History {
 public:
  History() = default;
  /// The first channel must be "time" (s). Nothing is written yet. Throws InputError on a name given twice or empty.
  History(std::string path, std::vector<Channel> channels);
  /// Reads a history file. Throws InputError naming file and dataset.
  static History load(const std::string& path);

  /// One value per channel, in their order. Throws RunError when the number differs.
  void append(std::span<const double> row);
  /// Writes the whole file atomically, so a reader finds the old file or the new one, never half of it. Throws
  /// RunError.
  void flush();
  /// Drops all rows but the first `count`, as a resume does: a time says less, for stages without time end at the same.
  void keep_first(std::size_t count);

  std::size_t rows() const { return columns_.empty() ? 0 : columns_[0].size(); }
  const std::string& path() const { return path_; }
  const std::vector<Channel>& channels() const { return channels_; }
  bool has(const std::string& channel) const { return index_.contains(channel); }
  /// Throws InputError naming the file and the channels it does have.
  const std::vector<double>& values(const std::string& channel) const;
  const std::vector<double>& time() const { return values("time"); }

 private:
  std::size_t index_of(const std::string& channel) const;
  std::string path_;
  std::vector<Channel> channels_;
  std::vector<std::vector<double>> columns_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace voussoir
