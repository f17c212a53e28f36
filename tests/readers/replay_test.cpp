// The fuzzers' corpus and deterministic mutations of it through all readers: an answer or an error for a person, and no
// crash, wherever a fuzzer cannot be built.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "geometry/generator.h"
#include "io/hdf5/assembly_file.h"
#include "solver/base/atomic_file.h"
#include "tests/folder.h"
#include "tools/fuzz/readers.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

struct Reader {
  const char* name;
  void (*read)(const std::string& bytes);
  int mutations;  // of each file of the corpus
};

const std::vector<Reader> text_readers = {{"case", fuzz::read_case, 150},        {"record", fuzz::read_record, 1000},
                                          {"surface", fuzz::read_surface, 1000}, {"mesh", fuzz::read_mesh, 1000},
                                          {"table", fuzz::read_table, 400},      {"vehicle", fuzz::read_vehicle, 300},
                                          {"json", fuzz::read_json, 2000}};

std::vector<std::string> corpus(const std::string& name) {
  std::vector<std::string> paths, files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(VOUSSOIR_SOURCE_DIR) + "/tools/fuzz/corpus/" + name))
    paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths) files.push_back(read_text(path));
  return files;
}

/// What people, editors, disks and programs do to files.
class Mutator {
 public:
  std::string mutated(std::string bytes, const std::string& other, std::size_t kept = 0) {
    for (std::size_t times = 1 + below(3); times > 0; --times) change(bytes, other, kept);
    return bytes;
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : std::size_t(random_() % n); }

  void change(std::string& bytes, const std::string& other, std::size_t kept) {
    static const std::vector<std::string> numbers = {"-1",
                                                     "0",
                                                     "1e308",
                                                     "-1e308",
                                                     "1e-320",
                                                     "inf",
                                                     "-nan",
                                                     "2147483648",
                                                     "-9223372036854775808",
                                                     "18446744073709551616",
                                                     "1e999",
                                                     "0x7f",
                                                     "1,5",
                                                     ""};
    if (bytes.size() <= kept) return;
    const std::size_t at = kept + below(bytes.size() - kept), length = 1 + below(16);
    switch (below(8)) {
      case 0:
        bytes[at] = char(random_());
        return;
      case 1:
        bytes[at] = char(bytes[at] ^ (1 << below(8)));
        return;
      case 2:
        bytes.erase(at, length);
        return;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        return;
      case 4:
        bytes.resize(at);
        return;
      case 5: {  // a line that comes twice
        const std::size_t begin = std::max(kept, bytes.rfind('\n', at) + 1), end = bytes.find('\n', at);
        const std::string line = bytes.substr(begin, end == std::string::npos ? end : end + 1 - begin);
        bytes.insert(begin, line);
        return;
      }
      case 6: {
        const std::size_t first = bytes.find_first_of("0123456789", at);
        if (first == std::string::npos) return;
        const std::size_t last = std::min(bytes.find_first_not_of("0123456789.eE+-", first), bytes.size());
        bytes.replace(first, last - first, numbers[below(numbers.size())]);
        return;
      }
      default: {
        const std::size_t from = below(other.size());
        bytes.replace(at, length, other.substr(from, 1 + below(64)));
      }
    }
  }

  std::mt19937_64 random_{20240507};
};

class Readers : public testing::TestWithParam<Reader> {};

TEST_P(Readers, TakeTheirCorpusAndWhatBecomesOfIt) {
  const std::vector<std::string> files = corpus(GetParam().name);
  ASSERT_FALSE(files.empty());
  Mutator mutator;
  for (std::size_t i = 0; i < files.size(); ++i) {
    GetParam().read(files[i]);
    for (int k = 0; k < GetParam().mutations; ++k)
      GetParam().read(mutator.mutated(files[i], files[(i + std::size_t(k)) % files.size()]));
  }
  GetParam().read("");
}

INSTANTIATE_TEST_SUITE_P(All, Readers, testing::ValuesIn(text_readers),
                         [](const auto& reader) { return std::string(reader.param.name); });

/// Behind the superblock, without which HDF5 reads nothing.
TEST(ReadersOfHdf5, TakeAnAssemblyAndWhatBecomesOfIt) {
  const Generator& column = find_generator("column");
  GeneratorInput input = default_input(column);
  input.values["blocks"] = 2.0;
  const test::Folder folder;
  write_assembly(folder / "column.h5", column.build(input));
  const std::string bytes = read_text(folder / "column.h5");
  Mutator mutator;
  fuzz::read_assembly(bytes);
  for (int k = 0; k < 300; ++k) fuzz::read_assembly(mutator.mutated(bytes, bytes, 96));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
