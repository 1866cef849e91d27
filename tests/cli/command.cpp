#include "cli/command.h"
#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <sched.h>
#include <sstream>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace bake::test {
namespace {

/// Programs with sanitizers take several times as long.
#ifdef __SANITIZE_ADDRESS__
constexpr double patience = 4;
#else
constexpr double patience = 1;
#endif

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Processor time that a process which is not yet waited for has taken, of all its threads.
double processor_seconds(pid_t process) {
    clockid_t clock{};
    timespec used{};
    if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0;
    return double(used.tv_sec) + 1e-9 * double(used.tv_nsec);
}

const char* group_folder() {
    return access("/sys/fs/cgroup/memory", F_OK) == 0 ? "/sys/fs/cgroup/memory" : "/sys/fs/cgroup";
}

/// In a mount namespace of its own, this process sees a file memory.max of the outermost control group. No memory is
/// limited, so that what exceeds the limit is seen to do so.
bool simulate_group(long long bytes) {
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("none", group_folder(), "tmpfs", 0, nullptr) != 0)
        return false;
    const std::string file = std::string(group_folder()) + "/memory.max", text = std::to_string(bytes) + "\n";
    const int number = open(file.c_str(), O_WRONLY | O_CREAT, 0644);
    return number >= 0 && write(number, text.data(), text.size()) == ssize_t(text.size()) && close(number) == 0;
}

/// In the child, before the command.
bool set_limits(const RunLimits& limits) {
    if (limits.group_bytes >= 0 && !simulate_group(limits.group_bytes)) return false;
    std::vector<std::pair<int, long long>> all = limits.resources;
    if (limits.file_bytes >= 0) all.emplace_back(RLIMIT_FSIZE, limits.file_bytes);
    for (const auto& [resource, most] : all) {
        rlimit limit{};
        getrlimit(resource, &limit);
        limit.rlim_cur = rlim_t(most);
        if (!limits.soft) limit.rlim_max = rlim_t(most);
        setrlimit(resource, &limit);
    }
    for (int inherited = 3; inherited < 1024; ++inherited) close(inherited);
    const int user = limits.as_nobody ? 65534 : limits.user;
    return user < 0 || (setgid(gid_t(user)) == 0 && setuid(uid_t(user)) == 0);
}

} // namespace

bool may_simulate_group() {
    if (geteuid() != 0) return false;
    // Without a mounted control group the command does not look for a limit.
    std::ifstream mounts("/proc/self/mountinfo");
    const std::string all{std::istreambuf_iterator<char>(mounts), {}};
    if (all.find(std::string(" ") + group_folder()) == std::string::npos || all.find(" - cgroup") == std::string::npos)
        return false;
    // Only trying tells: a container can lack the right, and in a changed root the root need not be a mount.
    const pid_t child = fork();
    if (child == 0) _exit(simulate_group(1 << 30) ? 0 : 1);
    int status = 0;
    return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

Folder::Folder() {
    std::string name = (fs::temp_directory_path() / "bake_test_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    path = name;
}

Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
}

std::set<std::string> Folder::names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(path))
        all.insert(entry.path().lexically_relative(path).string());
    return all;
}

std::string contents(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const std::string& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

std::size_t lines(const std::string& text) { return std::size_t(std::count(text.begin(), text.end(), '\n')); }

Run run_bake(const Folder& folder, const std::vector<std::string>& arguments, const RunLimits& limits) {
    const char* bake = std::getenv("BAKE");
    REQUIRE_MESSAGE(bake, "BAKE names the command to test");
    // Outside the folder, so that the command's own traces stand alone in it.
    const Folder streams;
    const std::string out = limits.stdout_path.empty() ? streams / "out" : limits.stdout_path, err = streams / "err";
    std::vector<char*> argv{const_cast<char*>(bake)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const std::string where = folder.path.string();

    const double start = now();
    const pid_t child = fork();
    if (child == 0) {
        dup2(open(out.c_str(), O_WRONLY | O_CREAT, 0600), 1);
        dup2(open(err.c_str(), O_WRONLY | O_CREAT, 0600), 2);
        if (chdir(where.c_str()) != 0 || !set_limits(limits)) _exit(126);
        execv(bake, argv.data());
        _exit(127);
    }
    REQUIRE(child > 0);
    int status = 0;
    rusage used{};
    bool interrupted = false;
    const double most = patience * limits.seconds;
    while (wait4(child, &status, WNOHANG, &used) == 0) {
        const double elapsed = now() - start;
        if (!interrupted && limits.interrupt_after >= 0 && elapsed > limits.interrupt_after) {
            kill(child, limits.signal);
            if (limits.twice) std::this_thread::sleep_for(std::chrono::milliseconds(10));
            if (limits.twice) kill(child, limits.signal);
            interrupted = true;
        }
        // A machine that is busy with other work makes no run fail; one that waits for ever takes no processor time.
        if (elapsed > 15 * most || (elapsed > most && processor_seconds(child) > most)) kill(child, SIGKILL);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    Run run;
    run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run.seconds = now() - start;
    run.peak_mib = double(used.ru_maxrss) / 1024;
    run.out = contents(streams / "out");
    run.err = contents(err);
    return run;
}

void check_refused(const Folder& folder, const std::vector<std::string>& arguments, int code, const std::string& named,
                   const RunLimits& limits) {
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    CAPTURE(line);
    const auto before = folder.names();
    const Run run = run_bake(folder, arguments, limits);
    CAPTURE(run.err);
    CHECK(run.code == code);
    const bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
    CHECK((run.out == "" || (json && run.out.find("\"error\": ") != std::string::npos)));
    CHECK(lines(run.err) == 1);
    CHECK(run.err.starts_with("bake: "));
    CHECK(run.err.find(named) != std::string::npos);
    CHECK(folder.names() == before);
}

std::vector<std::string> verbs() {
    const Folder folder;
    std::istringstream help(run_bake(folder, {"--help"}).out);
    std::vector<std::string> names;
    std::string line;
    while (std::getline(help, line) && line != "Subcommands:") {
    }
    while (std::getline(help, line) && line.starts_with("  "))
        if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
    REQUIRE(names.size() >= 8);
    return names;
}

Image<float> read_level(const std::string& file, int mip) {
    const fs::path reader = fs::path(std::getenv("BAKE")).parent_path() / "read_mip";
    FILE* const pipe = popen(("'" + reader.string() + "' '" + file + "' " + std::to_string(mip)).c_str(), "r");
    REQUIRE(pipe);
    int size[3];
    Image<float> image;
    if (std::fread(size, sizeof size, 1, pipe) == 1) {
        image = Image<float>(size[0], size[1], size[2]);
        CHECK(std::fread(image.data(), sizeof(float), image.size(), pipe) == image.size());
    }
    CHECK(pclose(pipe) == 0);
    return image;
}

} // namespace bake::test
