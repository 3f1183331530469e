#pragma once

namespace dollytrack {

/// First argument of dollytrack-import that makes it run another program in confinement.
inline constexpr const char* kConfine = "--confine";

/// Replaces this process by another program that can read and execute what the system has
/// installed, read `FOLDER`, and write only below `WORK`; it has no network and cannot reach other
/// processes. It dies with its parent. For programs that open untrusted files. Arguments: name of
/// this program, kConfine, id of the parent process, WORK, FOLDER, the program's path, its
/// arguments. Returns an exit code only on failure: 2 for wrong arguments, 3 if the system offers
/// no confinement, 4 if the program cannot be started.
int runConfined(int count, char** arguments);

}  // namespace dollytrack
