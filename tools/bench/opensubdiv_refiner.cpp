#include "tools/bench/opensubdiv_refiner.h"

#include <cstdint>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>
#include <vector>

namespace supple::bench {

using namespace OpenSubdiv;

std::unique_ptr<Far::TopologyRefiner> opensubdivRefiner(const cage::Cage& cage, Sdc::SchemeType scheme,
                                                        const FaceVaryingChannel* channel) {
    std::vector<int> sides, vertices(cage.faceVertices.begin(), cage.faceVertices.end()), creases, corners, holes;
    std::vector<float> creaseWeights, cornerWeights;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        sides.push_back(static_cast<int>(cage.sides(f)));
    }
    for (const cage::Crease& crease : cage.creases) {
        creases.insert(creases.end(), {static_cast<int>(crease.a), static_cast<int>(crease.b)});
        creaseWeights.push_back(crease.sharpness);
    }
    for (const cage::SharpVertex& sharp : cage.sharpVertices) {
        corners.push_back(static_cast<int>(sharp.vertex));
        cornerWeights.push_back(sharp.sharpness);
    }
    holes.assign(cage.holes.begin(), cage.holes.end());

    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(cage.vertexCount());
    descriptor.numFaces = static_cast<int>(cage.faceCount());
    descriptor.numVertsPerFace = sides.data();
    descriptor.vertIndicesPerFace = vertices.data();
    descriptor.numCreases = static_cast<int>(creaseWeights.size());
    descriptor.creaseVertexIndexPairs = creases.data();
    descriptor.creaseWeights = creaseWeights.data();
    descriptor.numCorners = static_cast<int>(corners.size());
    descriptor.cornerVertexIndices = corners.data();
    descriptor.cornerWeights = cornerWeights.data();
    descriptor.numHoles = static_cast<int>(holes.size());
    descriptor.holeIndices = holes.data();
    Far::TopologyDescriptor::FVarChannel values;
    Sdc::Options options;
    if (channel != nullptr) {
        values.numValues = channel->count;
        values.valueIndices = channel->values.data();
        descriptor.numFVarChannels = 1;
        descriptor.fvarChannels = &values;
        options.SetFVarLinearInterpolation(channel->linear);
    }
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(descriptor, Factory::Options(scheme, options)));
}

} // namespace supple::bench
