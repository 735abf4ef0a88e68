#include "tools/bench/blend_cpu.h"

#include "host/jobs.h"
#include "surface/blend/mesh.h"
#include "surface/blend/weights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace supple::bench {
namespace {

namespace blend = surface::blend;
constexpr uint32_t kBatch = 32; ///< faces or charts that a thread takes at a time

/// Places and slopes of the samples in a chart of k turns, without its rotation: index y * side + x.
struct Table {
    std::vector<glm::vec2> points, slopes, directions;
};

struct Eta {
    float value, slope;
};

} // namespace

struct BlendCpu::Inside {
    blend::Mesh mesh;
    uint32_t rate = 1, side = 2;
    std::vector<std::vector<float>> matrices; ///< per class: 9 rows
    std::vector<Table> tables;                ///< per class
    std::vector<Eta> eta;
    std::vector<std::array<glm::vec3, blend::kCoefficients>> charts;
    std::vector<float> vertices;

    void fit(uint32_t chart);
    void evaluate(uint32_t face);
};

void BlendCpu::Inside::fit(uint32_t index) {
    const blend::Chart& chart = mesh.charts[index];
    const std::vector<float>& matrix = matrices[chart.chartClass];
    const size_t ring = matrix.size() / blend::kCoefficients;
    const glm::vec3 vertex = mesh.cage.positions[chart.vertex];
    for (size_t row = 0; row < blend::kCoefficients; ++row) {
        glm::vec3 sum(0.0f);
        for (size_t i = 0; i < ring; ++i)
            sum += matrix[row * ring + i] * (mesh.cage.positions[mesh.ring[chart.firstRing + i]] - vertex);
        charts[index][row] = row == 0 ? vertex + sum : sum;
    }
}

void BlendCpu::Inside::evaluate(uint32_t face) {
    struct Corner {
        const glm::vec3* c;
        const Table* table;
        glm::vec2 direction;
    };
    std::array<Corner, 4> corners;
    for (uint32_t k = 0; k < 4; ++k) {
        const blend::Corner& corner = mesh.corners[4 * face + k];
        const Table& table = tables[mesh.charts[corner.chart].chartClass];
        corners[k] = {charts[corner.chart].data(), &table, table.directions[corner.sector]};
    }
    const glm::vec3 origin = corners[0].c[0];
    float* out = &vertices[size_t{face} * side * side * 6];
    for (uint32_t j = 0; j < side; ++j) {
        for (uint32_t i = 0; i < side; ++i, out += 6) {
            const uint32_t x[] = {i, j, rate - i, rate - j}, y[] = {j, rate - i, rate - j, i};
            glm::vec3 position(0.0f), dx[4], dy[4];
            for (uint32_t k = 0; k < 4; ++k) {
                const Corner& corner = corners[k];
                const size_t at = size_t{y[k]} * side + x[k];
                const glm::vec2 z = corner.table->points[at], g = corner.table->slopes[at], d = corner.direction;
                const float u = z.x * d.x - z.y * d.y, v = z.x * d.y + z.y * d.x;
                const float gx = g.x * d.x - g.y * d.y, gy = g.x * d.y + g.y * d.x;
                const glm::vec3* const c = corner.c;
                const glm::vec3 c0 = c[1] + u * (c[4] + u * c[7]), c1 = c[2] + u * (c[5] + u * c[8]);
                const glm::vec3 offset = (c[0] - origin) + u * (c[3] + u * c[6]) + v * (c0 + v * c1);
                const glm::vec3 pu =
                    c[3] + 2.0f * u * c[6] + v * ((c[4] + 2.0f * u * c[7]) + v * (c[5] + 2.0f * u * c[8]));
                const glm::vec3 pv = c0 + 2.0f * v * c1;
                const Eta ex = eta[x[k]], ey = eta[y[k]];
                const float weight = ex.value * ey.value;
                position += weight * offset;
                dx[k] = ex.slope * ey.value * offset + weight * (gx * pu + gy * pv);
                dy[k] = ex.value * ey.slope * offset + weight * (gx * pv - gy * pu);
            }
            glm::vec3 normal = glm::cross((dx[0] - dx[2]) + (dy[3] - dy[1]), (dy[0] - dy[2]) + (dx[1] - dx[3]));
            if ((i == 0 || i == rate) && (j == 0 || j == rate)) { // a chart's middle has the limit of normals
                const glm::vec3* const c = corners[j == 0 ? (i == 0 ? 0 : 1) : i == 0 ? 3 : 2].c;
                normal = glm::cross(c[3], c[1]);
            }
            normal /= std::sqrt(glm::dot(normal, normal));
            position += origin;
            std::copy_n(&position.x, 3, out);
            std::copy_n(&normal.x, 3, out + 3);
        }
    }
}

BlendCpu::BlendCpu(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
BlendCpu::~BlendCpu() = default;

Result<std::unique_ptr<BlendCpu>> BlendCpu::create(const cage::Cage& cage, uint32_t rate) {
    Result<blend::Mesh> mesh = blend::buildMesh(cage);
    if (!mesh)
        return mesh.error();
    auto inside = std::make_unique<Inside>();
    inside->mesh = std::move(*mesh);
    inside->rate = rate;
    inside->side = rate + 1;
    for (const blend::ChartClass& chartClass : inside->mesh.classes) {
        if (chartClass.kind != blend::ChartKind::interior)
            return Error{ErrorCode::asset, "blend on the CPU takes closed cages without creases"};
        const blend::FitMatrix matrix = blend::makeFitMatrix(chartClass);
        inside->matrices.emplace_back(matrix.weights.begin(), matrix.weights.end());
        const blend::ChartTable chart = blend::makeChartTable(chartClass.turns(), rate);
        Table& table = inside->tables.emplace_back();
        table.directions.assign(chart.directions.begin(), chart.directions.end());
        for (uint32_t y = 0; y <= rate; ++y) {
            for (uint32_t x = 0; x <= rate; ++x) {
                const size_t at = size_t{y} * blend::coordinateCount(rate) + x;
                table.points.emplace_back(chart.points[at]);
                table.slopes.emplace_back(chart.slopes[at]);
            }
        }
    }
    for (uint32_t i = 0; i <= rate; ++i) {
        const double t = static_cast<double>(i) / rate;
        inside->eta.push_back(
            {static_cast<float>((2.0 * t - 3.0) * t * t + 1.0), static_cast<float>(6.0 * t * (t - 1.0))});
    }
    inside->charts.resize(inside->mesh.charts.size());
    inside->vertices.resize(size_t{inside->mesh.cage.faceCount()} * inside->side * inside->side * 6);
    return std::unique_ptr<BlendCpu>(new BlendCpu(std::move(inside)));
}

void BlendCpu::run(bool allThreads) {
    const auto each = [&](size_t count, const auto& work) {
        if (!allThreads) {
            for (uint32_t i = 0; i < count; ++i)
                work(i);
            return;
        }
        host::inParallel(static_cast<uint32_t>((count + kBatch - 1) / kBatch), [&](uint32_t batch) {
            for (uint32_t i = batch * kBatch; i < std::min<size_t>(count, (batch + 1) * kBatch); ++i)
                work(i);
        });
    };
    each(inside_->charts.size(), [&](uint32_t chart) { inside_->fit(chart); });
    each(inside_->mesh.cage.faceCount(), [&](uint32_t face) { inside_->evaluate(face); });
}

std::span<const float> BlendCpu::vertices() const {
    return inside_->vertices;
}

} // namespace supple::bench
