#include "bake/picture/bc5.h"
#include "bake/base/parallel.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace bake {
namespace {

constexpr int side = 4, texels = side * side, channel_bytes = 8, block_bytes = 2 * channel_bytes;
constexpr float largest = 255;

/// Four floats as one value of the compiler, which takes loops over plain arrays of 16 apart into single floats.
using Four = float __attribute__((vector_size(16)));
/// One channel of a block by rows, in levels: 0 to 255.
using Block = std::array<Four, side>;

Four four(float value) noexcept { return Four{value, value, value, value}; }
Four smaller(const Four& a, const Four& b) noexcept { return a < b ? a : b; }
Four larger(const Four& a, const Four& b) noexcept { return a > b ? a : b; }
float sum(const Four& v) noexcept { return (v[0] + v[1]) + (v[2] + v[3]); }

/// The values that the indices of a block choose from: steps + 1 of them from low to high. With 5 steps also 0 and 255.
struct Ladder {
    int low = 0, high = 0, steps = 7;
    float error = std::numeric_limits<float>::max(); ///< sum of squares over the block
};

/// The nearest steps, whole numbers from 0 to `steps`, of values between the ends of a ladder.
template <int steps> class NearestSteps {
public:
    NearestSteps(float low, float high) noexcept
        : low_(four(low)), scale_(four(high > low ? steps / (high - low) : 0)) {}
    Four operator()(const Four& values) const noexcept {
        // Floats of this size have no fraction: adding and subtracting it rounds to the nearest whole number.
        constexpr float whole = 3 << 22;
        const Four step = ((values - low_) * scale_ + whole) - whole;
        return smaller(larger(step, four(0)), four(steps));
    }

private:
    Four low_, scale_;
};

template <int steps> float squared_error(const Block& block, float low, float high) noexcept {
    const NearestSteps<steps> nearest(low, high);
    const float step = (high - low) / steps;
    Four squares = four(0);
    for (const Four& values : block) {
        const Four error = values - (low + nearest(values) * step);
        Four square = error * error;
        if constexpr (steps == 5) {
            const Four below = values, above = largest - values;
            square = smaller(square, smaller(below * below, above * above));
        }
        squares += square;
    }
    return sum(squares);
}

/// Moves the ends to the least squares fit of the block for the steps that its values have now.
void fit_line(const Block& block, float& low, float& high) noexcept {
    constexpr int steps = 7;
    const NearestSteps<steps> nearest(low, high);
    Four step_sums = four(0), value_sums = four(0), square_sums = four(0), product_sums = four(0);
    for (const Four& values : block) {
        const Four step = nearest(values);
        step_sums += step, value_sums += values, square_sums += step * step, product_sums += step * values;
    }
    const float s = sum(step_sums), v = sum(value_sums), determinant = texels * sum(square_sums) - s * s;
    if (determinant <= 0) return; // all values have the same step
    const float slope = (texels * sum(product_sums) - s * v) / determinant;
    low = (v - slope * s) / texels;
    high = low + steps * slope;
}

/// Extremes of a block.
struct Range {
    float least, most;
    float width() const noexcept { return most - least; }
};

Range range_of(const Block& block) noexcept {
    const Four least = smaller(smaller(block[0], block[1]), smaller(block[2], block[3]));
    const Four most = larger(larger(block[0], block[1]), larger(block[2], block[3]));
    return {std::min(std::min(least[0], least[1]), std::min(least[2], least[3])),
            std::max(std::max(most[0], most[1]), std::max(most[2], most[3]))};
}

/// Tries all pairs of ends within `reach` levels of low and high. Pairs are left out if the errors of the block's extremes
/// alone exceed the smallest error found.
template <int steps>
void search(const Block& block, const Range& range, float low, float high, int reach, Ladder& best) noexcept {
    constexpr int apart = steps == 7; // equal ends would mean 5 steps
    const int a0 = std::clamp(int(low + 0.5f), 0, 255 - apart), b0 = std::clamp(int(high + 0.5f), a0 + apart, 255);
    for (int a = std::max(0, a0 - reach); a <= std::min(255, a0 + reach); ++a) {
        const float above = std::max(0.0f, float(a) - range.least);
        if (steps == 7 && above * above >= best.error) break;
        for (int b = std::min(255, b0 + reach); b >= std::max(a + apart, b0 - reach); --b) {
            const float below = std::max(0.0f, range.most - float(b));
            if (steps == 7 && above * above + below * below >= best.error) break;
            const float error = squared_error<steps>(block, float(a), float(b));
            if (error < best.error) best = {a, b, steps, error};
        }
    }
}

Ladder fit(const Block& block) noexcept {
    // In a narrow range the remainders of the ends decide, in a wide one their places do.
    constexpr float narrow = 8, tiny = 0.5f;
    const Range range = range_of(block);
    Ladder best;
    float low = range.least, high = range.most;
    if (range.width() < narrow) {
        const float inset = range.width() / 32;
        search<7>(block, range, low + inset, high - inset, 4, best);
    } else {
        fit_line(block, low, high);
        fit_line(block, low, high);
        search<7>(block, range, low, high, 2, best);
    }
    // Fifths of a level may be nearer than sevenths, and 0 and 255 are of use to blocks that come near them.
    if (range.width() < tiny) search<5>(block, range, range.least, range.most, 2, best);
    if (range.least >= 2 && range.most <= largest - 2) return best;
    Range inner{largest, 0};
    for (int i = 0; i < texels; ++i)
        if (const float value = block[i / side][i % side]; value >= 2 && value <= largest - 2)
            inner = {std::min(inner.least, value), std::max(inner.most, value)};
    if (inner.least > inner.most) inner = range;
    search<5>(block, range, inner.least, inner.most, 2, best);
    return best;
}

/// The index of a step: 0 and 1 are the ends as they are stored, the larger first with 7 steps.
int index_of(int steps, int step) noexcept {
    if (steps == 7) return step == 7 ? 0 : step == 0 ? 1 : 8 - step;
    return step == 0 ? 0 : step == 5 ? 1 : step + 1;
}

template <int steps> void pack(const Block& block, const Ladder& ladder, char* to) noexcept {
    const auto low = float(ladder.low), high = float(ladder.high), step = (high - low) / steps;
    const NearestSteps<steps> nearest(low, high);
    std::uint64_t bits = 0;
    for (int j = 0; j < side; ++j) {
        const Four places = nearest(block[j]);
        for (int i = 0; i < side; ++i) {
            const float value = block[j][i], error = std::abs(value - (low + places[i] * step));
            int index = index_of(steps, int(places[i]));
            if (steps == 5 && value < error) index = 6;
            else if (steps == 5 && largest - value < error) index = 7;
            bits |= std::uint64_t(index) << 3 * (j * side + i);
        }
    }
    to[0] = char(steps == 7 ? ladder.high : ladder.low);
    to[1] = char(steps == 7 ? ladder.low : ladder.high);
    for (int i = 0; i < 6; ++i) to[2 + i] = char(bits >> 8 * i);
}

void encode(const Block& block, char* to) noexcept {
    const Ladder ladder = fit(block);
    if (ladder.steps == 7) pack<7>(block, ladder, to);
    else pack<5>(block, ladder, to);
}

/// One channel of the block whose first texel is (x, y).
Block gather(const Image<float>& normals, int x, int y, int channel) noexcept {
    Block block;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const float value =
                normals.at(std::min(x + i, normals.width() - 1), std::min(y + j, normals.height() - 1), channel);
            // Written so that NaN becomes 0.
            block[j][i] = value > -1 ? (std::min(value, 1.0f) + 1) * (largest / 2) : 0.0f;
        }
    return block;
}

/// The eight values of a channel, in [-1,1].
std::array<float, 8> values_of(const char* from) noexcept {
    const auto a = float(static_cast<unsigned char>(from[0])), b = float(static_cast<unsigned char>(from[1]));
    std::array<float, 8> values{a, b};
    if (a > b)
        for (int i = 2; i < 8; ++i) values[i] = (float(8 - i) * a + float(i - 1) * b) / 7;
    else {
        for (int i = 2; i < 6; ++i) values[i] = (float(6 - i) * a + float(i - 1) * b) / 5;
        values[6] = 0, values[7] = largest;
    }
    for (float& value : values) value = value * (2 / largest) - 1;
    return values;
}

void unpack(const char* from, int x, int y, int channel, Image<float>& normals) noexcept {
    const std::array<float, 8> values = values_of(from);
    std::uint64_t bits = 0;
    for (int i = 0; i < 6; ++i) bits |= std::uint64_t(static_cast<unsigned char>(from[2 + i])) << 8 * i;
    for (int j = 0; j < std::min(side, normals.height() - y); ++j)
        for (int i = 0; i < std::min(side, normals.width() - x); ++i)
            normals.at(x + i, y + j, channel) = values[bits >> 3 * (j * side + i) & 7];
}

void fill_z(Image<float>& normals, int y) noexcept {
    float* n = normals.row(y);
    for (int x = 0; x < normals.width(); ++x, n += normals.channels())
        n[2] = std::sqrt(std::max(0.0f, 1 - n[0] * n[0] - n[1] * n[1]));
}

int blocks_along(int size) noexcept { return (size + side - 1) / side; }

/// Calls work(x, y, at) for every block: its first texel, and the place of its bytes.
template <class Work> void for_blocks(int width, int height, Work&& work) {
    const int columns = blocks_along(width);
    for_rows(blocks_along(height), 4, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t row = begin; row < end; ++row)
            for (int column = 0; column < columns; ++column)
                work(column * side, int(row) * side, std::size_t(row * columns + column) * block_bytes);
    });
}

} // namespace

std::size_t bc5_bytes(int width, int height) noexcept {
    return std::size_t(blocks_along(width)) * std::size_t(blocks_along(height)) * block_bytes;
}

std::string bc5_encode(const Image<float>& normals) {
    std::string bytes(bc5_bytes(normals.width(), normals.height()), '\0');
    for_blocks(normals.width(), normals.height(), [&](int x, int y, std::size_t at) {
        for (int channel = 0; channel < 2; ++channel) {
            encode(gather(normals, x, y, channel), bytes.data() + at + channel * channel_bytes);
        }
    });
    return bytes;
}

void bc5_decode(const char* blocks, Image<float>& normals) {
    for_blocks(normals.width(), normals.height(), [&](int x, int y, std::size_t at) {
        for (int channel = 0; channel < 2; ++channel)
            unpack(blocks + at + channel * channel_bytes, x, y, channel, normals);
    });
    if (normals.channels() < 3) return;
    for_rows(normals.height(), 16, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = int(begin); y < int(end); ++y) fill_z(normals, y);
    });
}

void bc5_round(Image<float>& normals) { bc5_decode(bc5_encode(normals).data(), normals); }

} // namespace bake
