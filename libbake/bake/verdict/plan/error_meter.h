// The error of a candidate against a reference in the metric of a budget: of one object, seen by one camera.
#pragma once
#include "bake/verdict/plan/budget.h"
#include "bake/verdict/plan/pixel_probe.h"

namespace bake {

/// Estimates of every metric come as squares: of the mean FLIP and of the mean angle in degrees, too.
class ErrorMeter {
public:
    /// The reference must outlive the object.
    ErrorMeter(Budget::Metric metric, const ProbedScene& reference, std::vector<Pixel> pixels,
               const ProbeOptions& options);

    /// `can_be_finer`: the reference; then the looks end as with StoppingRule::until_reference.
    ReferenceProbe::Result judge(const ProbedScene& candidate, double budget, double reference_error,
                                 bool can_be_finer = false);
    /// Of at least `pixels` object pixels where the metric can do with fewer than all.
    SquareEstimate measure(const ProbedScene& candidate, int pixels);
    /// Mean FLIP, from fewer samples than a budget by FLIP takes.
    double flip(const ProbedScene& candidate);
    /// Timed milliseconds of a million rays that see the object, on all threads.
    double ms(const ProbedScene& candidate) const;
    std::size_t pixels() const noexcept { return probe_.pixels().size(); }

private:
    SquareEstimate estimate(const ProbedScene& candidate) const;

    Budget::Metric metric_;
    ProbedScene reference_;
    ProbeOptions options_;
    ReferenceProbe probe_;
};

} // namespace bake
