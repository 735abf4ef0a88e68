// One mesh per instance (SUPPLE_GROUP_INDEXED_MESH, SUPPLE_SCHEME_POLYGONS): samples on the borders of patches are
// stored once, and an index buffer with one draw range per material draws it all.
#include "runtime/tessellation/one_rate.h"

namespace supple::runtime {

namespace {

class IndexedMesh final : public OneRate {
public:
    explicit IndexedMesh(const TessellationDesc& desc) : OneRate(desc) {}
    [[nodiscard]] Status begin();
    [[nodiscard]] SuppleTessellation kind() const override { return SUPPLE_TESSELLATION_INDEXED_MESH; }
    /// Polygons are drawn as they are.
    [[nodiscard]] uint32_t gridRate() const override { return isMesh() ? 1 : evaluation_.rate; }
    [[nodiscard]] std::vector<uint32_t> verticesOf(uint32_t patch, uint32_t rate) const override {
        return rate == gridRate() ? surface::meshVertices(tables(), evaluation_, patch) : std::vector<uint32_t>();
    }
    [[nodiscard]] Status prepareRate(uint32_t rate) override;
};

Status IndexedMesh::begin() {
    Status status = buildTables();
    if (!status) {
        return status;
    }
    status = setVertexCount(evaluation_.layOut(tables()));
    status = status ? prepare() : status;
    if (!status) {
        return status;
    }
    Result<IndexBytes> indices = layOutMesh(evaluation_, vertexCount_);
    if (!indices) {
        return indices.error();
    }
    indexData_ = std::move(*indices);
    setDraws(std::move(draws_));
    return success();
}

Status IndexedMesh::prepareRate(uint32_t rate) {
    if (rate == built_.askedRate) {
        return success();
    }
    return Error{ErrorCode::argument, desc_.asset->character.name +
                                          ": the indices of an indexed mesh are made for rate " +
                                          std::to_string(built_.askedRate) + " alone"};
}

} // namespace

Result<std::unique_ptr<Tessellation>> makeIndexedMesh(const TessellationDesc& desc) {
    return begun(std::make_unique<IndexedMesh>(desc));
}

} // namespace supple::runtime
