// Preparation of a run directory.
#pragma once
#include <functional>

#include "io/case/case.h"
#include "tools/run/directory_lock.h"

namespace voussoir {

/// Makes a run directory with the resolved case and the assembly, and locks it. An existing run is replaced only if
/// `overwrite` is true. Calls `remark` for each remark on case and assembly. Throws InputError, before anything is
/// written, if the case does not fit its assembly; RunError if a file cannot be written.
DirectoryLock prepare_directory(const Case& c, const std::string& directory, bool overwrite,
                                const std::function<void(const std::string&)>& remark = {});

}  // namespace voussoir
