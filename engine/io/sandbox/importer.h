#pragma once

namespace dollytrack::io {

/// The whole of the program `dollytrack-import`: locks itself up, reads one scene file and hands
/// the frame back. Returns the exit code: 0 when a frame was handed back (be it an error), 2 when
/// it was not called as it should be, 1 when it cannot hand anything back.
int runImporter(int count, char** arguments);

}  // namespace dollytrack::io
