#pragma once

namespace dollytrack {

/// Installs a seccomp filter: from now on this process can only read files, use memory, create
/// threads and exit; every other system call fails with EPERM. It can start no program or process,
/// use no socket, open no file for writing and execute no generated code. `openat2`: whether that
/// call is allowed. Returns false if the filter cannot be installed.
[[nodiscard]] bool installSyscallFilter(bool openat2);

}  // namespace dollytrack
