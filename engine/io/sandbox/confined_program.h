#pragma once

#include <cstdint>

namespace dollytrack {

/// First argument of dollytrack-import that makes it run another program in confinement.
inline constexpr const char* kConfine = "--confine";

/// Memory limit of a program that runConfined() runs (RLIMIT_DATA), bytes.
inline constexpr std::uint64_t kMostConfinedData = std::uint64_t{8} << 30U;

/// Exit codes of runConfined() when it could not start the program.
enum ConfinedExit : int {
    kWrongArguments = 122,
    kCannotConfine = 123,  // the system has no Landlock or no seccomp
    kCannotStart = 124,    // the program cannot be executed in confinement
};

/// Runs another program in this process, confined: it can read and execute installed programs
/// (/usr, /opt), read /etc, information about the system and FOLDER, and write only below WORK. It
/// has no sockets, starts no processes, and cannot signal, trace or change other processes. The
/// kernel kills it when its parent thread ends. For programs that open untrusted files. Arguments:
/// name of this program, kConfine, id of the parent process, WORK, FOLDER, the program's path, its
/// arguments. Returns a ConfinedExit if it fails.
int runConfined(int count, char** arguments);

}  // namespace dollytrack
