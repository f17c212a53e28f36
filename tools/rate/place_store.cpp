#include "tools/rate/place_store.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/hdf5/assembly_file.h"
#include "solver/base/build_info.h"
#include "solver/base/folder.h"
#include "solver/base/json_file.h"

namespace voussoir {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RatedPlace, found, factor, above, local, fill_alone, spans, share, moving, tries,
                                   seconds)

PlaceStore::PlaceStore(std::string folder, const Case& c, const Assembly& assembly, const RateRequest& request)
    : folder_(std::move(folder)),
      case_(c),
      request_(request),
      common_(fmt::format("{} {} {:x} {:x} {} {}", program_version(), build_commit(), c.hash, assembly_hash(assembly),
                          request.most, request.tolerance)) {}

std::string PlaceStore::file_of(const RatedPlace& at) const {
  return fmt::format("{}/{:016x}.json", folder_, hash_text(common_ + with_vehicle(case_, request_, at, false).text));
}

bool PlaceStore::recall(RatedPlace& at) const {
  const nlohmann::json stored = json_if_any(file_of(at));
  if (!stored.is_object()) return false;
  stored.get_to(at);
  return true;
}

void PlaceStore::keep(const RatedPlace& at) const {
  const std::string file = file_of(at);
  make_folder_of(file);
  write_json(file, at);
}

void PlaceStore::clear() const {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace voussoir
