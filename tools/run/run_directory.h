// Run directories: how they begin.
#pragma once
#include <functional>

#include "io/case/case.h"
#include "tools/run/directory_lock.h"

namespace voussoir {

/// A fresh run directory with the resolved case and the assembly, locked. An existing run is never overwritten unasked.
/// Throws InputError, before anything is written, for what the case asks of its assembly and cannot be; RunError.
/// `remark` is told the remarks on case and assembly before that.
DirectoryLock prepare_directory(const Case& c, const std::string& directory, bool overwrite,
                                const std::function<void(const std::string&)>& remark = {});

}  // namespace voussoir
