#pragma once

namespace dollytrack {

/// The program `dollytrack-import`: isolates itself, reads one scene file and hands the scene back.
/// Returns the exit code: 0 if a scene or its error was handed back; 2 if the arguments are wrong;
/// 1 if nothing could be handed back.
int runImporter(int count, char** arguments);

}  // namespace dollytrack
