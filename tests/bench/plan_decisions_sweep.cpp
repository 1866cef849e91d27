// plan_decisions_sweep: what `bake plan` decides in the configurations of plan_experiment_set.h, for scripts/plan_experiment.
//
//   plan_decisions_sweep TRUTH.csv [--threads N] [--data FOLDER] [--meshes FOLDER] [--seed N] [--only N] [--done FILE]
//
// Takes number and exposure of each configuration from the truth, and prints one row of csv per configuration and budget: the
// chosen model, processor seconds, and all rungs in the order of their cost, each as name|how it is known|square|standard
// error|bound. Rows without a head are for appending to the file after --done; its configurations are left out.
#include "bake/base/error.h"
#include "bake/base/parallel.h"
#include "bake/verdict/compare/compared_scene.h"
#include "bake/verdict/plan/plan.h"
#include "plan_experiment_set.h"
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>

using namespace bench;

namespace {

constexpr const char* known_words[] = {"bound", "probe", "not settled", "not tried", "skipped"};

struct KnownTrial {
    int number = 0;
    float exposure = 0;
};

std::vector<KnownTrial> trials_in(const std::string& file) {
    std::ifstream in(file);
    std::string line;
    if (!std::getline(in, line)) throw Error(Refusal::unreadable, file + ": is missing or empty");
    const auto cells = [](const std::string& row) {
        std::vector<std::string> list;
        std::istringstream words(row);
        for (std::string word; std::getline(words, word, ',');) list.push_back(word);
        return list;
    };
    const std::vector<std::string> head = cells(line);
    const auto column = std::size_t(std::find(head.begin(), head.end(), "exposure") - head.begin());
    std::vector<KnownTrial> list;
    while (std::getline(in, line)) {
        const std::vector<std::string> row = cells(line);
        if (row.size() > column) list.push_back({std::stoi(row[0]), std::stof(row[column])});
    }
    return list;
}

template <class Work> double cpu_seconds(Work&& work) {
    const std::clock_t start = std::clock();
    work();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

void print_decision(int number, double budget, const ObjectPlan& plan, double seconds, double reference_seconds) {
    const bool chosen = plan.chosen >= 0;
    std::printf("%d,%g,%s,%.4f,%s,%.4f,%.4g,", number, budget,
                name(chosen ? plan.rungs[std::size_t(plan.chosen)].method : plan.reference).c_str(), seconds,
                name(plan.reference).c_str(), reference_seconds, plan.reference_error);
    for (std::size_t i = 0; i < plan.rungs.size(); ++i) {
        const Rung& rung = plan.rungs[i];
        std::printf("%s%s|%s|%.4g|%.2g|%.3g", i ? ";" : "", name(rung.method).c_str(), known_words[int(rung.known)],
                    rung.error.square, rung.error.error, rung.bound);
    }
    std::printf("\n");
    std::fflush(stdout);
}

void decide(const PlanTrial& trial, std::uint32_t seed) {
    std::string measured;
    double reference_seconds = 0;
    for (const double budget : plan_budgets) {
        PlanOptions options;
        options.budget.value = budget;
        options.seed = seed;
        options.neighbours = false; // what is only told beside the decision
        ScenePlan plan;
        const double seconds = cpu_seconds([&] { plan = plan_scene(trial.entries, options); });
        if (plan.objects.size() != 1) throw Error(Refusal::unsuitable, trial.entries.file + ": no object was planned");
        const ObjectPlan& object = plan.objects.front();
        if (measured != name(object.reference)) {
            measured = name(object.reference);
            const ComparedScene scenes(trial.entries, "");
            reference_seconds = cpu_seconds([&] { scenes.load(object.reference); });
        }
        print_decision(trial.number, budget, object, seconds, reference_seconds);
    }
}

} // namespace

int main(int argc, char** argv) try {
    if (argc < 2) throw Error(Refusal::usage, "the file with the truth is missing");
    PlanFolders folders{"../shared/data", "meshes"};
    int threads = 1, only = -1;
    std::string done_file;
    std::uint32_t seed = 0;
    for (int i = 2; i + 1 < argc; i += 2) {
        const auto is = [&](const char* word) { return std::strcmp(argv[i], word) == 0; };
        if (is("--threads")) threads = std::stoi(argv[i + 1]);
        else if (is("--data")) folders.data = argv[i + 1];
        else if (is("--meshes")) folders.meshes = argv[i + 1];
        else if (is("--seed")) seed = std::uint32_t(std::stoul(argv[i + 1]));
        else if (is("--done")) done_file = argv[i + 1];
        else if (is("--only")) only = std::stoi(argv[i + 1]);
        else throw Error(Refusal::usage, std::string(argv[i]) + ": is not known");
    }
    const ThreadLimit limit(threads);
    const PlanSet set(folders);
    const std::set<int> done = done_file.empty() ? std::set<int>{} : numbers_in(done_file);
    if (done_file.empty())
        std::printf("trial,budget,chosen,seconds,reference,reference_seconds,reference_error,rungs\n");
    for (const KnownTrial& known : trials_in(argv[1])) {
        if (done.contains(known.number) || (only >= 0 && known.number != only)) continue;
        PlanTrial trial = set.trial(known.number);
        trial.entries.settings.exposure = known.exposure;
        decide(trial, seed);
    }
} catch (const std::exception& error) {
    std::fprintf(stderr, "plan_decisions_sweep: %s\n", error.what());
    return 2;
}
