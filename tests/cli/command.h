// Runs the command from outside, within limits, and looks at everything it leaves behind.
#pragma once
#include "bake/picture/image.h"
#include "folders.h"
#include <csignal>
#include <cstdlib>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace bake::test {
namespace fs = std::filesystem;

/// A folder of its own, removed at the end.
struct Folder {
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string operator/(const std::string& name) const { return (path / name).string(); }
    /// Names of all that is in it, hidden files too.
    std::set<std::string> names() const;
    fs::path path;
};

std::string contents(const std::string& file);
void write_file(const std::string& file, const std::string& bytes);
std::size_t lines(const std::string& text);

struct RunLimits {
    /// Killed after, in processor time, and after 15 times as long in any case; four times as much with sanitizers.
    double seconds = 20;
    long long file_bytes = -1;   ///< largest file it may write; -1: any
    double interrupt_after = -1; ///< seconds after which the signal is sent; -1: never
    int signal = SIGINT;
    bool twice = false;     ///< the signal is sent again, 10 ms later
    bool as_nobody = false; ///< without root's rights
    int user = -1;          ///< as this user, who runs nothing else; -1: as the tests
    /// Further limits: RLIMIT_AS and its number, soft and hard.
    std::vector<std::pair<int, long long>> resources = {};
    bool soft = false;          ///< only the soft limit is set
    long long group_bytes = -1; ///< limit of a simulated control group (may_simulate_group()); -1: none
    std::string stdout_path;    ///< where stdout goes instead
};

struct Run {
    int code = -1; ///< 128 + signal when killed by one
    std::string out, err;
    double seconds = 0;
    double peak_mib = 0;
};

/// Whether RunLimits::group_bytes and RunLimits::user can be had.
bool may_simulate_group();

/// Runs $BAKE with these arguments in `folder` (its working directory).
Run run_bake(const Folder& folder, const std::vector<std::string>& arguments, const RunLimits& limits = {});

/// A refusal: this code, nothing on stdout, one line on stderr that starts "bake: " and has `named` in it, and no files
/// but those that were there.
void check_refused(const Folder& folder, const std::vector<std::string>& arguments, int code, const std::string& named,
                   const RunLimits& limits = {});

/// The verbs, as bake --help lists them.
std::vector<std::string> verbs();

/// A mip level of a file, read by OpenImageIO; empty when there is none.
Image<float> read_level(const std::string& file, int mip);

} // namespace bake::test
