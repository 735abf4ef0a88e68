#include "host/ktx2_decoder.h"

#include <cstring>
#include <limits>

#ifdef SUPPLE_HAS_BASISU
#include <basisu_transcoder.h>
#endif

namespace supple::host {

bool isKtx2(std::span<const std::byte> bytes) {
    constexpr unsigned char kSignature[] = {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
    return bytes.size() >= sizeof kSignature && std::memcmp(bytes.data(), kSignature, sizeof kSignature) == 0;
}

#ifdef SUPPLE_HAS_BASISU

namespace {

constexpr size_t kHeaderBytes = 80;
constexpr size_t kLevelBytes = 24;
/// Where the header has what. From the descriptor on these are an offset and a length, as the entries of levels are.
enum Place : size_t {
    kFormat = 12,
    kWidth = 20,
    kHeight = 24,
    kDepth = 28,
    kLayers = 32,
    kFaces = 36,
    kLevels = 40,
    kScheme = 44,
    kDescriptor = 48,
    kKeysAndValues = 56,
    kGlobals = 64 ///< what all levels of ETC1S have in common
};
constexpr uint64_t kBlockBytes = 16; // of UASTC, for 4 x 4 pixels
constexpr uint32_t kMostLevels = 16;
enum class Supercompression : uint32_t { none, basisLz, zstd };
constexpr uint32_t kModelEtc1s = 163, kModelUastc = 166;

/// What the headers of a file say. The transcoder believes some of it; here all of it is compared with the file first.
class Ktx2Headers {
public:
    explicit Ktx2Headers(std::span<const std::byte> bytes) : bytes_(bytes) {}

    [[nodiscard]] uint32_t width() const { return number<uint32_t>(kWidth); }
    [[nodiscard]] uint32_t height() const { return number<uint32_t>(kHeight); }

    /// Null if the file can be handed to the transcoder, else what is wrong.
    [[nodiscard]] const char* fault() const {
        if (bytes_.size() < kHeaderBytes || bytes_.size() > std::numeric_limits<uint32_t>::max()) {
            return "damaged";
        }
        const auto depth = number<uint32_t>(kDepth), layers = number<uint32_t>(kLayers),
                   faces = number<uint32_t>(kFaces);
        if (depth != 0 || layers > 1 || faces != 1) {
            return "a KTX2 of more than one picture";
        }
        const bool isWhole = width() > 0 && height() > 0 && hasLevels() && hasRange<uint32_t>(kDescriptor, 44);
        if (!isWhole) {
            return "damaged";
        }
        const auto scheme = static_cast<Supercompression>(number<uint32_t>(kScheme));
        const auto model = std::to_integer<uint32_t>(bytes_[number<uint32_t>(kDescriptor) + 12]);
        const bool isEtc1s = model == kModelEtc1s && scheme == Supercompression::basisLz;
        const bool isUastc =
            model == kModelUastc && (scheme == Supercompression::none || scheme == Supercompression::zstd);
        if (number<uint32_t>(kFormat) != 0 || !(isEtc1s || isUastc)) {
            return "a KTX2 that is neither ETC1S nor UASTC";
        }
        return (isEtc1s ? hasGlobals() : hasBlocks(scheme)) ? nullptr : "damaged";
    }

private:
    template <class Number>
    [[nodiscard]] Number number(size_t place) const {
        Number value;
        std::memcpy(&value, bytes_.data() + place, sizeof value);
        return value;
    }
    /// Whether an offset and a length, at `place`, lie within the file, and the length is `least` or more.
    template <class Number>
    [[nodiscard]] bool hasRange(size_t place, uint64_t least) const {
        const uint64_t offset = number<Number>(place), length = number<Number>(place + sizeof(Number));
        return offset <= bytes_.size() && length <= bytes_.size() - offset && length >= least;
    }
    [[nodiscard]] uint32_t levels() const { return number<uint32_t>(kLevels); }
    [[nodiscard]] bool hasLevels() const {
        if (levels() < 1 || levels() > kMostLevels || bytes_.size() < kHeaderBytes + levels() * kLevelBytes) {
            return false;
        }
        bool inside = true;
        for (uint32_t level = 0; level < levels(); ++level) {
            inside = inside && hasRange<uint64_t>(kHeaderBytes + level * kLevelBytes, 1);
        }
        return inside;
    }
    /// Five numbers of four bytes, then five for each level.
    [[nodiscard]] bool hasGlobals() const { return hasRange<uint64_t>(kGlobals, 20 + uint64_t{20} * levels()); }
    /// As many bytes as there are blocks. Where these lie in the file as they are, they lie on words.
    [[nodiscard]] bool hasBlocks(Supercompression scheme) const {
        const bool isPacked = scheme == Supercompression::zstd;
        const auto bytes = number<uint64_t>(kHeaderBytes + (isPacked ? 16 : 8));
        return bytes == blocks() * kBlockBytes && (isPacked || number<uint64_t>(kHeaderBytes) % 4 == 0);
    }
    [[nodiscard]] uint64_t blocks() const { return ((uint64_t{width()} + 3) / 4) * ((uint64_t{height()} + 3) / 4); }

    std::span<const std::byte> bytes_;
};

bool transcode(std::span<const std::byte> bytes, Picture& picture) {
    static const bool initialized = [] {
        basist::basisu_transcoder_init();
        return true;
    }();
    const auto pixels = static_cast<uint32_t>(picture.rgba.size() / 4);
    basist::ktx2_transcoder transcoder;
    return initialized && transcoder.init(bytes.data(), static_cast<uint32_t>(bytes.size())) &&
           transcoder.start_transcoding() &&
           transcoder.transcode_image_level(0, 0, 0, picture.rgba.data(), pixels,
                                            basist::transcoder_texture_format::cTFRGBA32);
}

} // namespace

Result<Picture> decodeKtx2(std::span<const std::byte> bytes, uint64_t mostPixels, const std::string& name) {
    const Ktx2Headers headers(bytes);
    if (const char* fault = headers.fault()) {
        return Error{ErrorCode::asset, name + ": " + fault};
    }
    if (uint64_t{headers.width()} * headers.height() > mostPixels) {
        return Error{ErrorCode::asset, name + ": more than " + std::to_string(mostPixels) + " pixels"};
    }
    // Keys and values are not needed: the transcoder finds none.
    std::vector<std::byte> file(bytes.begin(), bytes.end());
    std::fill_n(file.begin() + kKeysAndValues, 8, std::byte{0});
    Picture picture = Picture::blank(headers.width(), headers.height());
    if (!transcode(file, picture)) {
        return Error{ErrorCode::asset, name + ": damaged"};
    }
    return picture;
}

#else

Result<Picture> decodeKtx2(std::span<const std::byte>, uint64_t, const std::string& name) {
    return Error{ErrorCode::asset, name + ": KTX2, and supple was built without Basis Universal"};
}

#endif

} // namespace supple::host
