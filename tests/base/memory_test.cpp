#include "bake/base/memory.h"
#include "cli/command.h"
#include "memory_limits.h"

using namespace bake;
using bake::test::Folder;
namespace fs = std::filesystem;

namespace {

/// A folder that looks like / to control_group_limit().
struct FakeRoot {
    Folder folder;
    void write(const std::string& path, const std::string& text) const {
        fs::create_directories((folder.path / path).parent_path());
        test::write_file(folder / path, text);
    }
    std::optional<MemoryLimit> limit() const { return control_group_limit(folder.path.string()); }
};

const std::string unified = "22 1 8:1 / / rw,relatime - ext4 /dev/sda1 rw\n"
                            "30 22 0:26 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate\n";

} // namespace

TEST_SUITE("unit") {
    TEST_CASE("memory_limit: the least of a control group and of all groups around it, memory.max and memory.high") {
        const FakeRoot root;
        CHECK(!root.limit());
        root.write("proc/self/mountinfo", unified);
        root.write("proc/self/cgroup", "0::/build/job\n");
        root.write("sys/fs/cgroup/build/job/memory.max", "max\n");
        CHECK(!root.limit());
        root.write("sys/fs/cgroup/build/memory.max", "500000000\n");
        REQUIRE(root.limit());
        CHECK(root.limit()->bytes == 500000000);
        CHECK(root.limit()->reason == "memory.max of control group /build");
        root.write("sys/fs/cgroup/build/job/memory.high", "300000000\n");
        CHECK(root.limit()->bytes == 300000000);
        CHECK(root.limit()->reason == "memory.high of control group /build/job");
        root.write("sys/fs/cgroup/memory.max", "1000\n"); // a container sees its own group as the root
        CHECK(root.limit()->bytes == 1000);
        CHECK(root.limit()->reason == "memory.max of control group /");
    }

    TEST_CASE("memory_limit: version 1, and a container whose mounted folder is its own group") {
        const FakeRoot root;
        root.write("proc/self/mountinfo",
                   "40 30 0:31 /docker/abc /sys/fs/cgroup/my\\040memory ro - cgroup cgroup rw,memory\n"
                   "41 30 0:32 /docker/abc /sys/fs/cgroup/cpu ro - cgroup cgroup rw,cpu\nnot a mount\n");
        root.write("proc/self/cgroup",
                   "9:name=systemd:/other\n8:cpu,cpuacct:/docker/abc\n4:memory:/docker/abc/in\n0::/\n");
        root.write("sys/fs/cgroup/cpu/memory.limit_in_bytes", "5\n");
        CHECK(!root.limit());
        root.write("sys/fs/cgroup/my memory/memory.limit_in_bytes", "700\n");
        REQUIRE(root.limit());
        CHECK(root.limit()->bytes == 700);
        root.write("sys/fs/cgroup/my memory/in/memory.limit_in_bytes", "600\n");
        CHECK(root.limit()->bytes == 600);
        CHECK(root.limit()->reason == "memory.limit_in_bytes of control group /in");
    }

    TEST_CASE("memory_limit: what is taken lies below the limit") {
        CHECK(process_memory().resident > 1 << 20);
        CHECK(process_memory().resident <= process_memory().address_space);
        CHECK(peak_memory() > 1 << 20);
        const MemoryLimit limit = memory_limit();
        CHECK(limit.bytes > 1 << 20);
        CHECK(!limit.reason.empty());
    }

    TEST_CASE("memory_limit: RLIMIT_AS and RLIMIT_DATA, without what is mapped and not resident" *
              doctest::skip(!test::keeps_memory_limits())) {
        for (const int resource : {RLIMIT_AS, RLIMIT_DATA}) {
            rlimit before{};
            REQUIRE(getrlimit(resource, &before) == 0);
            const ProcessMemory now = process_memory();
            const std::uint64_t mapped = resource == RLIMIT_AS ? now.address_space : now.data;
            rlimit lower = before;
            lower.rlim_cur = mapped + (64 << 20);
            REQUIRE(setrlimit(resource, &lower) == 0);
            const MemoryLimit limit = memory_limit();
            setrlimit(resource, &before);
            CHECK(limit.reason == (resource == RLIMIT_AS ? "ulimit -v" : "ulimit -d"));
            CHECK(double(limit.bytes) == doctest::Approx(double(now.resident + (64 << 20))).epsilon(0.05));
        }
    }

    TEST_CASE("MemoryCap: memory_limit() knows the lowest, and a started process has none" *
              doctest::skip(!test::keeps_memory_limits())) {
        const MemoryLimit before = memory_limit();
        const auto started = started_process_limit();
        const auto same = [&] {
            const auto now = started_process_limit();
            return now.has_value() == started.has_value() && (!now || now->bytes == started->bytes);
        };
        {
            const MemoryCap outer({std::uint64_t(300) << 20, "`outer`"}, 0);
            CHECK(memory_limit().bytes == std::uint64_t(300) << 20);
            CHECK(memory_limit().described() == "the 300 MiB it may use (`outer`)");
            CHECK(memory_limit().advice() == "raise `outer`");
            {
                const MemoryCap higher({std::uint64_t(400) << 20, "`higher`"}, 0);
                CHECK(memory_limit().reason == "`outer`");
                const MemoryCap lower({std::uint64_t(200) << 20, "`lower`"}, 0);
                CHECK(memory_limit().reason == "`lower`");
                CHECK(same());
                const std::size_t much = std::size_t(500) << 20;
                CHECK_THROWS_AS(std::vector<char>(much, 'a'), std::bad_alloc);
                {
                    const MemoryCapPause pause;
                    CHECK_NOTHROW(std::vector<char>(much, 'a'));
                }
                CHECK_THROWS_AS(std::vector<char>(much, 'a'), std::bad_alloc);
            }
            CHECK(memory_limit().reason == "`outer`");
        }
        CHECK(memory_limit().reason == before.reason);
        CHECK(same());
    }

    TEST_CASE("MemoryCap: allocations beyond it fail, and no longer once it is gone" *
              doctest::skip(!test::keeps_memory_limits())) {
        const std::size_t much = std::size_t(256) << 20;
        {
            const MemoryCap cap({process_memory().resident + (std::size_t(64) << 20), "a test"}, 2);
            CHECK_THROWS_AS(std::vector<char>(much, 'a'), std::bad_alloc);
            CHECK_NOTHROW(std::vector<char>(std::size_t(32) << 20, 'a'));
        }
        CHECK_NOTHROW(std::vector<char>(much, 'a'));
    }
}
