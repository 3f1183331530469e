#include "ui/widgets/keyboard_wait.h"

#include <utility>

namespace dollytrack::ui {
namespace {

bool awaited = false;  // one flag is enough: there is one keyboard

}  // namespace

void awaitKeyboard() {
    awaited = true;
}

bool takeKeyboardAwaited() {
    return std::exchange(awaited, false);
}

}  // namespace dollytrack::ui
