// A ray of its own, without the packet in which pictures trace theirs.
#pragma once
#include "bake/preview/tracer.h"
#include <array>

namespace bake::test {

inline PrimaryHit trace_one(const Scene& scene, const Ray& ray, int bounces, const Sampler& sampler) {
    std::array<PrimaryRay, packet_size> rays;
    std::array<PrimaryHit, packet_size> hits;
    rays[0].ray = ray, rays[0].sampler = sampler;
    trace(scene, rays, 1, bounces, true, hits);
    return hits[0];
}

} // namespace bake::test
