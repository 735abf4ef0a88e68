// For a library that is built with SUPPLE_WITH_CPU=OFF.
#include "runtime/queries/query_pieces.h"

namespace supple::runtime {

Result<PieceTable> pieceTable(const CpuGroup& /*group*/, uint64_t /*mostElements*/) {
    return Error{ErrorCode::disabled, "the library has no surfaces to query"}; // without them it is not asked
}

} // namespace supple::runtime
