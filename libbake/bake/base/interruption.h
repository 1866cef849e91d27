// For work that leaves something of worth when the user stops it.
#pragma once

namespace bake {

/// For a verb that writes what it has when the user asked to stop: interrupted() is false in the current job from here on, so that files
/// can be written. Another signal still ends the process at once and leaves no unfinished file. Returns whether the
/// user had asked to stop and there is time to write: false when the processor time is over.
bool accept_interrupt() noexcept;

} // namespace bake
