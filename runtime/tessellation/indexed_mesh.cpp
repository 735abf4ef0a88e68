// One mesh per instance (SUPPLE_GROUP_INDEXED_MESH): samples on the borders of patches are stored once, and an index
// buffer with one draw range per material draws it all.
#include "surface/indexed_mesh.h"

#include "runtime/tessellation/one_rate.h"

namespace supple::runtime {

namespace {

class IndexedMesh final : public OneRate {
public:
    explicit IndexedMesh(const TessellationDesc& desc) : OneRate(desc) { indexBytes_ = sizeof(uint32_t); }
    [[nodiscard]] Status begin();
    [[nodiscard]] SuppleTessellation kind() const override { return SUPPLE_TESSELLATION_INDEXED_MESH; }
    [[nodiscard]] Status setRate(uint32_t rate) override;
};

Status IndexedMesh::begin() {
    Status status = buildTables();
    if (!status) {
        return status;
    }
    const uint64_t vertices = evaluation_.layOut(tables());
    status = setVertexCount(vertices);
    const uint32_t mostIndex = desc_.device->limits.maxDrawIndexedIndexValue;
    if (status && vertices > mostIndex) {
        return Error{ErrorCode::limit, desc_.asset->character.name + ": " + std::to_string(vertices) +
                                           " vertices of a mesh; an index of this device is at most " +
                                           std::to_string(mostIndex)};
    }
    status = status ? prepare() : status;
    if (!status) {
        return status;
    }
    const surface::IndexedMesh mesh = surface::indexedMesh(tables(), evaluation_);
    std::vector<SuppleDrawRange> draws;
    for (const surface::IndexedMesh::Range& from : mesh.ranges) {
        draws.push_back(
            {0, 1, from.material, SUPPLE_DOMAIN_MESH, vertexCount_, 0, from.firstIndex, from.indexCount, from.part});
    }
    setDraws(std::move(draws));
    const std::span<const std::byte> bytes = std::as_bytes(std::span(mesh.indices));
    indexData_.assign(bytes.begin(), bytes.end());
    return success();
}

Status IndexedMesh::setRate(uint32_t rate) {
    if (rate == askedRate_) {
        return success();
    }
    return Error{ErrorCode::argument, desc_.asset->character.name +
                                          ": the indices of an indexed mesh are made for rate " +
                                          std::to_string(askedRate_) + " alone"};
}

} // namespace

Result<std::unique_ptr<Tessellation>> makeIndexedMesh(const TessellationDesc& desc) {
    return begun(std::make_unique<IndexedMesh>(desc));
}

} // namespace supple::runtime
