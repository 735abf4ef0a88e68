// A character out of a host's arrays.
#include "cage/single_joint.h"
#include "cage/trim.h"
#include "runtime/asset.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace supple::runtime {

namespace {

using std::to_string;

/// Copies the arrays into a cage. Each step refuses the first element that is out of range.
class ArrayReader {
public:
    ArrayReader(const SuppleCageDesc& desc, const std::string& name, cage::Cage& cage)
        : desc_(desc), name_(name), cage_(cage) {}

    Status read() {
        for (const auto step : {&ArrayReader::checkPointers, &ArrayReader::readVertices, &ArrayReader::readFaces,
                                &ArrayReader::readCorners, &ArrayReader::readSharpness, &ArrayReader::readHoles}) {
            Status status = (this->*step)();
            if (!status) {
                return status;
            }
        }
        return success();
    }

private:
    [[nodiscard]] Status refuse(const std::string& reason) const {
        return Error{ErrorCode::asset, name_ + ": " + reason};
    }

    Status checkPointers() {
        if (desc_.positions == nullptr || desc_.faceVertexCounts == nullptr || desc_.faceVertexIndices == nullptr) {
            return Error{ErrorCode::nullPointer, name_ + ": positions, faceVertexCounts or faceVertexIndices is null"};
        }
        if (desc_.vertexCount == 0 || desc_.faceCount == 0) {
            return refuse("no vertices or no faces");
        }
        const auto present = [](uint32_t count, auto... arrays) { return count == 0 || (... && (arrays != nullptr)); };
        if (!present(desc_.creaseCount, desc_.creaseVertices, desc_.creaseSharpnesses) ||
            !present(desc_.cornerCount, desc_.cornerVertices, desc_.cornerSharpnesses) ||
            !present(desc_.creaseScalarCount, desc_.creaseScalars) || !present(desc_.holeCount, desc_.holes)) {
            return Error{ErrorCode::nullPointer, name_ + ": a count without its array"};
        }
        return success();
    }

    Status readVertices() {
        for (uint32_t v = 0; v < desc_.vertexCount; ++v) {
            const float* p = desc_.positions + 3 * size_t{v};
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
                return refuse("vertex " + to_string(v) + ": position is not finite");
            }
            cage_.positions.emplace_back(p[0], p[1], p[2]);
            cage_.sourceVertices.push_back(v);
        }
        return success();
    }

    Status readFaces() {
        cage_.faceStarts.push_back(0);
        uint64_t corners = 0;
        for (uint32_t f = 0; f < desc_.faceCount; ++f) {
            const uint32_t sides = desc_.faceVertexCounts[f];
            if (sides < 3) {
                return refuse("face " + to_string(f) + ": " + to_string(sides) + " corners");
            }
            corners += sides;
            if (corners > 0x7FFFFFFFu) {
                return refuse("face " + to_string(f) + ": more than 2^31 corners");
            }
            cage_.faceStarts.push_back(static_cast<uint32_t>(corners));
        }
        cage_.faceVertices.assign(desc_.faceVertexIndices, desc_.faceVertexIndices + corners);
        for (uint32_t f = 0; f < desc_.faceCount; ++f) {
            for (uint32_t c = cage_.faceStarts[f]; c < cage_.faceStarts[f + 1]; ++c) {
                if (cage_.faceVertices[c] >= desc_.vertexCount) {
                    return refuse("face " + to_string(f) + ": vertex " + to_string(cage_.faceVertices[c]) + " of " +
                                  to_string(desc_.vertexCount));
                }
            }
        }
        return success();
    }

    Status readCorners() {
        const auto read = [&](const float* uvs, std::vector<glm::vec2>& corners) {
            for (size_t c = 0; uvs != nullptr && c < cage_.faceVertices.size(); ++c) {
                corners.emplace_back(uvs[2 * c], uvs[2 * c + 1]);
            }
        };
        read(desc_.cornerUvs, cage_.cornerUvs);
        read(desc_.cornerUvs1, cage_.cornerUvs1);
        for (uint32_t f = 0; f < desc_.faceCount && desc_.faceTrimTiles != nullptr; ++f) {
            const uint32_t tile = desc_.faceTrimTiles[f];
            if (tile != SUPPLE_NO_TRIM_TILE && tile >= cage::kMaxTrimTiles) {
                return refuse("face " + to_string(f) + ": trim tile " + to_string(tile) + " of " +
                              to_string(cage::kMaxTrimTiles));
            }
            cage_.faceTrimTiles.push_back(tile);
        }
        return success();
    }

    Status readSharpness() {
        for (uint32_t i = 0; i < desc_.creaseCount; ++i) {
            const uint32_t a = desc_.creaseVertices[2 * size_t{i}], b = desc_.creaseVertices[2 * size_t{i} + 1];
            if (a >= desc_.vertexCount || b >= desc_.vertexCount || !(desc_.creaseSharpnesses[i] >= 0.0f)) {
                return refuse("crease " + to_string(i) + ": no such vertices, or no sharpness of 0 and more");
            }
            cage_.creases.push_back({a, b, desc_.creaseSharpnesses[i]});
        }
        for (uint32_t i = 0; i < desc_.cornerCount; ++i) {
            if (desc_.cornerVertices[i] >= desc_.vertexCount || !(desc_.cornerSharpnesses[i] >= 0.0f)) {
                return refuse("corner " + to_string(i) + ": no such vertex, or no sharpness of 0 and more");
            }
            cage_.sharpVertices.push_back({desc_.cornerVertices[i], desc_.cornerSharpnesses[i]});
        }
        for (uint32_t i = 0; i < desc_.creaseScalarCount; ++i) {
            const SuppleCreaseScalar& scalar = desc_.creaseScalars[i];
            if (!(scalar.alpha > 0.0f && scalar.alpha <= 1.0f)) {
                return refuse("crease scalar " + to_string(i) + ": alpha is not in (0, 1]");
            }
            cage_.creaseScalars.push_back({scalar.vertex, scalar.toward, scalar.alpha});
        }
        return success();
    }

    Status readHoles() {
        for (uint32_t i = 0; i < desc_.holeCount; ++i) {
            if (desc_.holes[i] >= desc_.faceCount) {
                return refuse("hole " + to_string(i) + ": face " + to_string(desc_.holes[i]) + " of " +
                              to_string(desc_.faceCount));
            }
            cage_.holes.push_back(desc_.holes[i]);
        }
        std::sort(cage_.holes.begin(), cage_.holes.end());
        cage_.holes.erase(std::unique(cage_.holes.begin(), cage_.holes.end()), cage_.holes.end());
        return success();
    }

    const SuppleCageDesc& desc_;
    const std::string& name_;
    cage::Cage& cage_;
};

} // namespace

Result<cage::Character> characterFromArrays(const SuppleCageDesc& desc, const std::string& name) {
    cage::Character character;
    const Status status = ArrayReader(desc, name, character.cage).read();
    if (!status) {
        return status.error();
    }
    character.name = name;
    cage::bindToOneJoint(character, name);
    character.sourceVertexCount = desc.vertexCount;
    return character;
}

} // namespace supple::runtime
