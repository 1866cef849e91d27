// bake <verb>: one command, on the streams and within the limits of the process.
#include "bake/base/memory.h"
#include "bake/base/parallel.h"
#include "run_command.h"
#include "verb.h"
#include <cstdio>

int main(int argc, char** argv) {
    bake::catch_interrupts();
    std::optional<bake::MemoryCap> cap;
    const auto limit = [&](int threads) {
        // Never destroyed, see ThreadLimit: a command that has one thread needs no others, to its end.
        [[maybe_unused]] static const auto* const threads_limit = new bake::ThreadLimit(threads);
        // Begins where the control group limits the memory, as the kernel ends a process that exceeds that limit.
        // The threads of TBB and those of OpenEXR.
        if (const auto group = bake::control_group_limit()) cap.emplace(*group, 2 * bake::thread_count());
    };
    const int code = bake::run_command({argv + 1, argv + argc}, {.draws = true, .begins = limit});
    if (std::fflush(stdout) != 0)
        return bake::fail("standard output: cannot be written; is the disk full?", bake::Refusal::unwritable);
    return code;
}
