// Files of complete places, with which an interrupted rating continues.
#pragma once
#include "tools/rate/rate.h"

namespace voussoir {

/// One file for each place. Its name is a hash of all that the result depends on: the program, the case, the assembly,
/// the loads of the vehicle and the settings of the search. The case and the request must outlive this object.
class PlaceStore {
 public:
  PlaceStore(std::string folder, const Case& c, const Assembly& assembly, const RateRequest& request);
  /// Fills in the result of the place. False if there is no file.
  bool recall(RatedPlace& at) const;
  void keep(const RatedPlace& at) const;
  /// Removes the folder.
  void clear() const;

 private:
  std::string file_of(const RatedPlace& at) const;

  std::string folder_;
  const Case& case_;
  const RateRequest& request_;
  std::string common_;  // the part of the hashed text that all places have
};

}  // namespace voussoir
