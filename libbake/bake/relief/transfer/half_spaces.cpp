// The nearest point x is the sum of multiples, none above 0, of the vectors a of the sides that x lies on (Karush, Kuhn and Tucker).
// Three sides that are independent are enough. As the problem is convex, any such x within all half-spaces is the answer.
#include "bake/relief/transfer/half_spaces.h"

namespace bake {
namespace {

constexpr double independent = 1e-6; ///< least squared sine between sides

class Search {
public:
    Search(std::span<const HalfSpace> spaces, double slack) : spaces_(spaces), slack_(slack) {}

    std::optional<Vec3d> run() const noexcept {
        if (is_within(Vec3d(0))) return Vec3d(0);
        const std::size_t count = spaces_.size();
        for (std::size_t i = 0; i < count; ++i)
            if (const auto x = on(i)) return x;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = i + 1; j < count; ++j)
                if (const auto x = on(i, j)) return x;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = i + 1; j < count; ++j)
                for (std::size_t k = j + 1; k < count; ++k)
                    if (const auto x = on(i, j, k)) return x;
        return {};
    }

private:
    bool is_within(const Vec3d& x) const noexcept {
        for (const HalfSpace& space : spaces_)
            if (glm::dot(space.a, x) > space.c + slack_) return false;
        return true;
    }
    std::optional<Vec3d> if_within(const Vec3d& x) const noexcept {
        return is_within(x) ? std::optional(x) : std::nullopt;
    }
    std::optional<Vec3d> on(std::size_t i) const noexcept {
        const auto& [a, c] = spaces_[i];
        return c <= 0 ? if_within(c * a) : std::nullopt;
    }
    std::optional<Vec3d> on(std::size_t i, std::size_t j) const noexcept {
        const HalfSpace &s = spaces_[i], &t = spaces_[j];
        const double cosine = glm::dot(s.a, t.a), sine2 = 1 - cosine * cosine;
        if (sine2 < independent) return {};
        const double u = (s.c - cosine * t.c) / sine2, v = (t.c - cosine * s.c) / sine2;
        return u <= 0 && v <= 0 ? if_within(u * s.a + v * t.a) : std::nullopt;
    }
    std::optional<Vec3d> on(std::size_t i, std::size_t j, std::size_t k) const noexcept {
        const HalfSpace &s = spaces_[i], &t = spaces_[j], &w = spaces_[k];
        const Vec3d tw = glm::cross(t.a, w.a), ws = glm::cross(w.a, s.a), st = glm::cross(s.a, t.a);
        const double volume = glm::dot(s.a, tw);
        if (volume * volume < independent) return {};
        const Vec3d x = (s.c * tw + t.c * ws + w.c * st) / volume;
        // The multiples: x = u s.a + v t.a + z w.a.
        const double u = glm::dot(x, tw) / volume, v = glm::dot(x, ws) / volume, z = glm::dot(x, st) / volume;
        return u <= slack_ && v <= slack_ && z <= slack_ ? if_within(x) : std::nullopt;
    }

    std::span<const HalfSpace> spaces_;
    double slack_;
};

} // namespace

std::optional<Vec3d> nearest_to_zero(std::span<const HalfSpace> spaces, double slack) noexcept {
    return Search(spaces, slack).run();
}

} // namespace bake
