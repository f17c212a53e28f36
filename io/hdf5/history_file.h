// Time series of a run: named channels, readable at any time during the run.
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

/// Rows in memory, and in the file after flush(). Every dataset is one-dimensional with one value for each row.
class History {
 public:
  History() = default;
  /// The first channel must be "time" (s). Nothing is written yet. Throws InputError for another first channel and for
  /// an empty or repeated name.
  History(std::string path, std::vector<Channel> channels);
  /// Reads a history file. Throws InputError with file and dataset.
  static History load(const std::string& path);

  /// Adds one value for each channel, in their order. Throws RunError if the number differs.
  void append(std::span<const double> row);
  /// Writes the file atomically: a reader finds the old file or the new one. Throws RunError.
  void flush();
  /// Keeps only the first `count` rows, for a restart. Rows are counted because several rows may have the same time.
  void keep_first(std::size_t count);

  std::size_t rows() const { return columns_.empty() ? 0 : columns_[0].size(); }
  const std::string& path() const { return path_; }
  const std::vector<Channel>& channels() const { return channels_; }
  bool has(const std::string& channel) const { return index_.contains(channel); }
  /// The values of a channel. Throws InputError with the file and its channels if there is none.
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
