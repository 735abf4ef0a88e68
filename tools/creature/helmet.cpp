// supple_helmet OUT.glb: makes the trimmed sample prop, always to the same bytes: a creased shell with an opening for
// the face, and a visor before it with slits and breathing holes that turns up. All holes are trims.

#include "cage/materials.h"
#include "tools/common/procedural.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>

using namespace supple::cage;

namespace {

constexpr uint32_t kShell = 0, kFront = 1, kVisor = 2; ///< materials
constexpr glm::vec3 kPivot(0.0f, 0.08f, 0.0f);         ///< the visor turns about an axis through the ears

// All numbers on a fixed grid, so that the last bits of a maths library cannot show in the file.
float rounded(double value) {
    return static_cast<float>(std::round(value * 1e5) / 1e5 + 0.0);
}
glm::vec3 rounded(const glm::vec3& v) {
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

// ---- images: gray PNGs whose pixels are stored as they are ----

void putNumber(std::vector<std::byte>& out, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        out.push_back(static_cast<std::byte>(value >> shift & 0xFF));
    }
}

uint32_t crc(std::span<const std::byte> bytes) {
    uint32_t value = 0xFFFFFFFFu;
    for (const std::byte byte : bytes) {
        value ^= std::to_integer<uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit) {
            value = value >> 1 ^ ((value & 1) != 0 ? 0xEDB88320u : 0u);
        }
    }
    return ~value;
}

void putChunk(std::vector<std::byte>& out, const char* name, const std::vector<std::byte>& data) {
    putNumber(out, static_cast<uint32_t>(data.size()));
    const size_t start = out.size();
    for (int i = 0; i < 4; ++i) {
        out.push_back(static_cast<std::byte>(name[i]));
    }
    out.insert(out.end(), data.begin(), data.end());
    putNumber(out, crc(std::span(out).subspan(start)));
}

/// White where `distance` is positive, black in the holes, and half way at their rims, over `width` in all.
std::vector<std::byte> paint(uint32_t columns, uint32_t rows, double width,
                             const std::function<double(double, double)>& distance) {
    std::vector<std::byte> lines;
    for (uint32_t y = 0; y < rows; ++y) {
        lines.push_back(std::byte{0}); // no filter
        for (uint32_t x = 0; x < columns; ++x) {
            const double d = distance((x + 0.5) / columns, (y + 0.5) / rows);
            lines.push_back(static_cast<std::byte>(std::lround(std::clamp(0.5 + d / width, 0.0, 1.0) * 255.0)));
        }
    }
    std::vector<std::byte> stream = {std::byte{0x78}, std::byte{0x01}};
    uint32_t a = 1, b = 0;
    for (size_t at = 0; at < lines.size(); at += 65535) {
        const size_t size = std::min<size_t>(65535, lines.size() - at);
        stream.push_back(std::byte{at + size == lines.size() ? uint8_t{1} : uint8_t{0}});
        for (const size_t value : {size, ~size}) {
            stream.push_back(static_cast<std::byte>(value & 0xFF));
            stream.push_back(static_cast<std::byte>(value >> 8 & 0xFF));
        }
        stream.insert(stream.end(), lines.begin() + static_cast<std::ptrdiff_t>(at),
                      lines.begin() + static_cast<std::ptrdiff_t>(at + size));
    }
    for (const std::byte byte : lines) {
        a = (a + std::to_integer<uint32_t>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    putNumber(stream, b << 16 | a);
    std::vector<std::byte> png;
    for (const unsigned value : {0x89, 'P' + 0, 'N' + 0, 'G' + 0, 0x0D, 0x0A, 0x1A, 0x0A}) {
        png.push_back(static_cast<std::byte>(value));
    }
    std::vector<std::byte> header;
    putNumber(header, columns);
    putNumber(header, rows);
    header.insert(header.end(), {std::byte{8}, std::byte{0}, std::byte{0}, std::byte{0}, std::byte{0}});
    putChunk(png, "IHDR", header);
    putChunk(png, "IDAT", stream);
    putChunk(png, "IEND", {});
    return png;
}

double box(double x, double y, double halfWidth, double halfHeight, double radius) {
    const double dx = std::abs(x) - halfWidth + radius, dy = std::abs(y) - halfHeight + radius;
    return std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0) - radius;
}

/// In units of the plate's height, which is three times as wide.
double visorHoles(double s, double t) {
    const double x = std::abs(s - 0.5) * 3.0, y = t - 0.5;
    double d = box(x - 0.56, y + 0.17, 0.40, 0.075, 0.03); // the slits, with straight sides
    d = std::min(d, 0.47 - 0.16 * x - y);                  // the jaw, cut straight
    for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 4 - row; ++column) {
            const double hx = 0.24 + 0.19 * column + 0.095 * row, hy = 0.07 + 0.155 * row;
            d = std::min(d, std::hypot(x - hx, y - hy) - 0.055); // round
        }
    }
    return d;
}

double faceOpening(double s, double t) {
    return box((s - 0.5) * 2.4, (t - 0.62) * 2.4, 0.58, 0.44, 0.24);
}

// ---- the cage ----

float smooth(float x) {
    x = std::clamp(x, 0.0f, 1.0f);
    return x * x * (3.0f - 2.0f * x);
}

/// The shell: a ball of six grids without the lowest one, longer than wide, with a comb over the middle.
void addShell(Cage& cage) {
    const Cage ball = makeCubeSphere(6);
    std::map<uint32_t, uint32_t> kept;
    for (uint32_t f = 0; f < ball.faceCount(); ++f) {
        const auto corners = std::span(ball.faceVertices).subspan(ball.faceStarts[f], 4);
        glm::vec3 middle(0.0f);
        for (const uint32_t v : corners) {
            middle += 0.25f * ball.positions[v];
        }
        if (middle.y < -0.62f) {
            continue;
        }
        for (const uint32_t v : corners) {
            const auto [known, isNew] = kept.try_emplace(v, cage.vertexCount());
            glm::vec3 p = ball.positions[v];
            const float height = std::max(0.0f, (p.y - 0.25f) / 0.75f);
            if (std::abs(p.x) < 1e-4f) {
                p *= 1.0f + 0.13f * std::sqrt(height);
            } else {
                // The grid lines beside it stand closer, so that the comb rises from a narrow foot.
                p.x *= 1.0f - 0.45f * smooth(height * 2.0f) * smooth((0.72f - std::abs(p.x)) / 0.46f);
                p = glm::normalize(p);
            }
            p *= glm::vec3(0.86f, 1.0f, 1.02f);
            if (isNew) {
                cage.positions.push_back(rounded(p));
            }
            cage.faceVertices.push_back(known->second);
            cage.cornerUvs.emplace_back(rounded(p.x / 2.4 + 0.5), rounded(0.5 - p.y / 2.4));
        }
        cage.faceStarts.push_back(cage.cornerCount());
        cage.faceMaterials.push_back(middle.z > 0.3f ? kFront : kShell);
        for (uint32_t k = 0; k < 4; ++k) {
            const uint32_t v = corners[k], w = corners[(k + 1) % 4];
            const glm::vec3 p = ball.positions[v], q = ball.positions[w];
            // Each edge from the one of its two faces that lies on the left.
            if (std::abs(p.x) + std::abs(q.x) < 1e-4f && std::min(p.y, q.y) > 0.25f && middle.x < 0.0f) {
                cage.creases.push_back({kept.at(v), kept.at(w), kHardSharpness});
            }
        }
    }
}

/// The visor: a plate round the front, drawn out to a keel in the middle.
void addVisor(Cage& cage) {
    constexpr uint32_t kColumns = 10, kRows = 4;
    const uint32_t first = cage.vertexCount();
    for (uint32_t j = 0; j <= kRows; ++j) {
        for (uint32_t i = 0; i <= kColumns; ++i) {
            const double s = static_cast<double>(i) / kColumns, t = static_cast<double>(j) / kRows;
            const double angle = (s - 0.5) * glm::radians(168.0);
            const double keel = std::max(0.0, 1.0 - std::abs(s - 0.5) * 5.0);
            const double out = 1.09 + 0.06 * std::sin(glm::pi<double>() * t) + 0.16 * keel * (0.4 + 0.6 * t);
            const double height = 0.50 - 1.12 * t;
            const double girth = std::sqrt(std::max(0.3, 1.0 - 0.55 * (height + 0.1) * (height + 0.1)));
            cage.positions.push_back(
                rounded(glm::vec3(0.89 * out * girth * std::sin(angle), height, 1.03 * out * girth * std::cos(angle))));
        }
    }
    const auto at = [&](uint32_t i, uint32_t j) { return first + j * (kColumns + 1) + i; };
    for (uint32_t j = 0; j < kRows; ++j) {
        for (uint32_t i = 0; i < kColumns; ++i) {
            const std::array<std::pair<uint32_t, uint32_t>, 4> corners{
                {{i, j + 1}, {i + 1, j + 1}, {i + 1, j}, {i, j}}};
            for (const auto& [x, y] : corners) {
                cage.faceVertices.push_back(at(x, y));
                cage.cornerUvs.emplace_back(rounded(static_cast<double>(x) / kColumns),
                                            rounded(static_cast<double>(y) / kRows));
            }
            cage.faceStarts.push_back(cage.cornerCount());
            cage.faceMaterials.push_back(kVisor);
        }
        cage.creases.push_back({at(kColumns / 2, j), at(kColumns / 2, j + 1), kHardSharpness});
    }
}

// ---- the rig ----

void addRig(Character& character, uint32_t shellVertices) {
    character.skeleton.nodes.resize(3);
    character.skeleton.nodes[0].name = "helmet";
    character.skeleton.nodes[1].name = "visor";
    character.skeleton.nodes[1].parent = 0;
    character.skeleton.nodes[1].translation = kPivot;
    character.skeleton.nodes[2].name = "helmet mesh";
    character.skeleton.parentsFirst = {0, 1, 2};
    character.parts[0].node = 2;
    character.parts[0].name = "helmet mesh";
    character.skin.joints = {0, 1};
    character.skin.inverseBinds.assign(2, glm::mat4(1.0f));
    character.skin.inverseBinds[1][3] = glm::vec4(-kPivot, 1.0f);
    character.weights.starts.push_back(0);
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        character.weights.influences.push_back({v < shellVertices ? 0u : 1u, 1.0f});
        character.weights.starts.push_back(v + 1);
    }

    // Looks aside, opens the visor, closes it, looks ahead again.
    Clip clip;
    clip.name = "salute";
    clip.duration = 4.0;
    Channel turn{0, ChannelPath::rotation, Interpolation::linear, {}, {}};
    Channel open{1, ChannelPath::rotation, Interpolation::linear, {}, {}};
    const auto ease = [](double from, double to, double time) {
        const double x = std::clamp((time - from) / (to - from), 0.0, 1.0);
        return x * x * (3.0 - 2.0 * x);
    };
    for (int frame = 0; frame <= 60; ++frame) {
        const double time = frame / 15.0;
        const double yaw = glm::radians(35.0) * (ease(0.2, 1.2, time) - ease(2.8, 3.8, time));
        const double lift = glm::radians(-68.0) * (ease(0.9, 1.8, time) - ease(2.4, 3.2, time));
        for (auto [channel, angle, axis] : {std::tuple(&turn, yaw, 1), std::tuple(&open, lift, 0)}) {
            channel->times.push_back(rounded(time));
            std::array<double, 4> q{0.0, 0.0, 0.0, std::cos(angle / 2)};
            q[static_cast<size_t>(axis)] = std::sin(angle / 2);
            for (const double part : q) {
                channel->values.push_back(rounded(part));
            }
        }
    }
    clip.channels = {turn, open};
    character.clips = {clip};
}

Character makeHelmet() {
    Character character;
    character.name = "helmet";
    character.copyright = "The Supple authors, MIT";
    character.cage.faceStarts.push_back(0);
    addShell(character.cage);
    const uint32_t shellVertices = character.cage.vertexCount();
    addVisor(character.cage);
    addRig(character, shellVertices);
    character.images = {{"opening", "image/png", paint(128, 128, 0.08, faceOpening)},
                        {"visor holes", "image/png", paint(384, 128, 0.05, visorHoles)}};
    character.materials.resize(3);
    const char* names[] = {"shell", "front", "visor"};
    for (uint32_t m = 0; m < 3; ++m) {
        character.materials[m] = namedMaterial(names[m]);
        character.materials[m].doubleSided = true;
        character.materials[m].baseColorFactor =
            m == kVisor ? glm::vec4(0.80f, 0.55f, 0.18f, 1.0f) : glm::vec4(0.10f, 0.20f, 0.34f, 1.0f);
    }
    for (const uint32_t m : {kFront, kVisor}) {
        character.materials[m].trim =
            Trim{.texture = {.image = m - 1, .wrapU = Wrap::clampToEdge, .wrapV = Wrap::clampToEdge}};
    }
    return character;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: supple_helmet OUT.glb\n");
        return 2;
    }
    const auto file = writeGlb(makeHelmet());
    if (!file || !file->warnings.empty()) {
        std::fprintf(stderr, "supple_helmet: %s\n", (file ? file->warnings[0] : file.error().message).c_str());
        return 1;
    }
    std::ofstream out(argv[1], std::ios::binary);
    out.write(reinterpret_cast<const char*>(file->bytes.data()), static_cast<std::streamsize>(file->bytes.size()));
    return out.flush() ? 0 : 1;
}
