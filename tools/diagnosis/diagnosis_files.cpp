#include "tools/diagnosis/diagnosis_files.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "io/case/case.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "tools/diagnosis/diagnosis_page.h"
#include "tools/diagnosis/diagnosis_pictures.h"
#include "tools/diagnosis/diagnosis_shapes.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// The corrected case with copies of its records and its assembly, in a folder within the results until put_in_place().
class CorrectedCase {
 public:
  CorrectedCase(const Case& c, const std::string& directory) : results_(directory), own_(results_ / "corrected.new") {
    fs::remove_all(own_);
    fs::create_directories(own_);
    write_self_contained_case(c, own_.string());
    fs::rename(own_ / "case.toml", own_ / "corrected.toml");
    for (const fs::directory_entry& file : fs::directory_iterator(own_)) names_.push_back(file.path().filename());
  }
  ~CorrectedCase() {
    std::error_code ignored;
    fs::remove_all(own_, ignored);
  }
  CorrectedCase(const CorrectedCase&) = delete;

  /// Throws InputError if the folder has other files with the names of the copies. Copies of an earlier diagnosis may
  /// be replaced.
  void check() const {
    if (fs::exists(results_ / "corrected.toml")) return;
    for (const fs::path& name : names_) {
      const fs::path there = results_ / name;
      if (!fs::exists(there)) continue;
      if (!fs::is_regular_file(there) || read_text(there.string()) != read_text((own_ / name).string()))
        throw InputError(
            "{} exists and is not a copy of the file that the case names. Choose another folder (-o, in Python "
            "directory)",
            there.string());
    }
  }
  void put_in_place() const {
    for (const fs::path& name : names_) fs::rename(own_ / name, results_ / name);
  }

 private:
  fs::path results_, own_;
  std::vector<fs::path> names_;
};

bool has_files(const Case& c) {
  return !c.assembly_file.empty() || std::any_of(c.motions.begin(), c.motions.end(), [](const MotionSource& m) {
    return m.kind == MotionSource::Kind::record;
  });
}

void write_corrected(const Case& corrected, const std::string& text, const std::string& directory) {
  if (!has_files(corrected)) return write_atomically(directory + "/corrected.toml", text);
  CorrectedCase(corrected, directory).put_in_place();
}

}  // namespace

void check_diagnosis_folder(const Case& c, const std::string& directory) {
  if (has_files(c)) CorrectedCase(c, directory).check();
}

void write_diagnosis(const DiagnosisInput& input, const DiagnosisResult& result, const std::string& directory,
                     bool page, const std::function<void(const std::string&)>& say) {
  fs::create_directories(directory);
  write_corrected(result.corrected, result.corrected_text, directory);
  write_json(directory + "/diagnosis.json", diagnosis_json(input, result));
  write_diagnosis_shapes(result, directory);
  if (!page) return;
  const std::vector<PagePicture> pictures = draw_diagnosis(input, result, directory, say);
  write_atomically(directory + "/diagnosis.html", diagnosis_page(input, result, pictures));
}

}  // namespace voussoir
