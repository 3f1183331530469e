#pragma once

namespace dollytrack::io {

/// seccomp: from now on this process can read files, use its memory, make threads and end; every
/// other system call fails with EPERM. No programs, processes, sockets, no code made at run time,
/// no file opened for writing. `openat2`: whether that call is allowed. False where it cannot be
/// had.
[[nodiscard]] bool filterCalls(bool openat2);

}  // namespace dollytrack::io
