// SPDX-License-Identifier: MIT
// What each way of storing a normal, a position, a roughness or a colour in a G-buffer costs, in bytes and in time to
// encode and decode, and how wrong it is.  The errors are computed on the CPU and need no device; the times are left
// empty where there is none.
//
//     encodings [--backend vulkan|opengl|both] [--device N|name] [--size WxH] [--rounds N]
//               [--clock auto|timestamps|wall] [--json FILE] [--svg FILE] [--quick]
//
// Exit status: 0 measured, or there is no device and none was named; 1 a result was wrong or a device failed; 2 usage;
// 4 the device that was named is not there.
#include "encodings/cost.hpp"
#include "encodings/pareto.hpp"
#include "support/pass_program.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

/// A plot: of which table, which rows of it, and which of their errors.
struct FamilyPlot {
    std::size_t table;
    const char* file;
    const char* title;
    const char* scene;  ///< the rows that are comparable
    const char* error;  ///< a further number; null: the largest error
    const char* y_label;
};
constexpr std::array<FamilyPlot, 5> plots = {
    {{0, "normals", "Normals", "normals", nullptr, "largest angle [degree]"},
     {1, "roughness", "Roughness", "roughness", nullptr, "largest error of GGX's peak, roughness 0.02 … 1, relative"},
     {2, "color", "Base colour", "base colour", nullptr, "largest error of linear light"},
     {3, "positions", "Positions, camera at the origin", "positions", nullptr, "largest |Δp|/|p|, far/near 1e4"},
     {3, "positions-far", "Positions, camera 1e5 m away", "positions", "camera 1e5 m away, max",
      "largest |Δp|/|p|, far/near 1e4"}}};

double further(const SpeedErrorRow& row, const char* name) {
    for (const NamedNumber& number : row.more)
        if (number.name == name) return number.value;
    return NAN;
}

/// Error against the further number `cost` of the rows.
Plot plot_of(const SpeedErrorTable& table, const FamilyPlot& family, const char* cost, const char* x_label,
             const std::string& where) {
    std::vector<PlotPoint> points;
    for (const SpeedErrorRow& row : table.rows)
        if (row.scene == family.scene && further(row, cost) > 0)
            points.push_back(
                {further(row, cost), family.error ? further(row, family.error) : row.max_error, row.method});
    return pareto_plot(std::string(family.title) + where, x_label, family.y_label, points);
}

/// The size of the picture makes MiB of bytes a pixel.
void set_size(SpeedErrorTable& table, Extent2D size) {
    table.size = size;
    const double pixels = static_cast<double>(size.width) * size.height;
    for (SpeedErrorRow& row : table.rows) row.bytes = static_cast<std::uint64_t>(further(row, "B/pixel") * pixels);
}

class Program {
public:
    explicit Program(const Options& options) : options_(options), quick_(options.flag("quick")) {
        errors_ = {normal_errors(quick_), roughness_errors(quick_), color_errors(quick_), position_errors(quick_)};
        for (SpeedErrorTable& table : errors_) {
            table.machine = describe_machine();
            set_size(table, {1920, 1080});
        }
    }

    /// The costs on one API's device.  Without one: a sentence is kept, unless it was asked for by name.
    template <rhi::Backend B>
    Result<void> measure(std::type_identity<B>) {
        auto made = B::create({.device = options_.text("device")});
        if (!made && made.error().code == Errc::no_device && options_.text("device").empty()) {
            missing_.push_back(made.error().message);
            return {};
        }
        std::unique_ptr<rhi::DeviceFor<B>> device;
        PELLUCID_TRY(device, std::move(made));
        const rhi::DeviceInfo info = device->info();
        PELLUCID_TRY(const PassSettings settings, pass_settings(options_, info));
        const std::vector<PixelAt> pixels = sample_pixels(settings.size, quick_ ? 28 : 60);
        std::vector<EncodingFamily> families = encoding_families(errors_, pixels, settings.size);
        PELLUCID_CHECK(add_costs<B>(*device, settings, families, pixels));
        for (EncodingFamily& family : families) {
            SpeedErrorTable& table = family.table;
            table.device = info;
            set_size(table, settings.size);
            table.notes.push_back("time: " + describe(settings) +
                                  "; textures convert unorm, snorm and binary16 by themselves: for those it is what a "
                                  "shader pays that does it itself");
            if (info.software) table.notes.emplace_back("a software device: only ratios are a claim");
            tables_.push_back(std::move(table));
        }
        return {};
    }

    Result<void> report() {
        if (tables_.empty()) tables_ = errors_;
        for (SpeedErrorTable& table : tables_) {
            for (const std::string& why : missing_) table.notes.push_back("not timed: " + why);
            std::printf("%s\n", to_markdown(table).c_str());
        }
        if (const std::string& file = options_.text("json"); !file.empty()) {
            JsonWriter json;
            json.begin_array();
            for (const SpeedErrorTable& table : tables_) write(json, table);
            json.end_array();
            PELLUCID_CHECK(write_file(file, json.text()));
        }
        if (const std::string& file = options_.text("svg"); !file.empty()) return draw(file);
        return {};
    }

private:
    static std::string describe(const PassSettings& settings) {
        return std::string(settings.timestamps ? "GPU timestamps" : "the clock around record, submit and wait") +
               "; medians of " + std::to_string(settings.rounds) + " rounds after " + std::to_string(settings.warm_up) +
               " to warm up";
    }

    /// FILE-normals-bytes.svg is the same for every device; FILE-normals-vulkan.svg is of that API's.
    Result<void> draw(const std::string& file) const {
        for (const FamilyPlot& family : plots) {
            const SpeedErrorTable& errors = errors_[family.table];
            const std::string name = family.file;
            if (name != "color")  // all of them take three bytes
                PELLUCID_CHECK(write_file(with_suffix(file, name + "-bytes"),
                                          to_svg(plot_of(errors, family, "B/pixel", "bytes a pixel", ""))));
            for (std::size_t first = 0; first < tables_.size(); first += errors_.size()) {
                const SpeedErrorTable& table = tables_[first + family.table];
                const rhi::DeviceInfo& device = table.device;
                if (device.backend.empty()) continue;
                const Plot plot = plot_of(table, family, "ns a value", "encode and decode [ns a value]",
                                          ": " + device.backend + ", " + device.name);
                PELLUCID_CHECK(write_file(with_suffix(file, name + "-" + device.backend), to_svg(plot)));
            }
        }
        return {};
    }

    const Options& options_;
    bool quick_;
    std::vector<SpeedErrorTable> errors_;  ///< one a family: normals, roughness, colour, positions
    std::vector<SpeedErrorTable> tables_;  ///< the same with costs, for each device in turn
    std::vector<std::string> missing_;     ///< why there is no device
};

Result<void> run(int argc, char** argv) {
    Options options = pass_options();
    PELLUCID_CHECK(options.parse(argc, argv));
    if (options.text("bandwidth") != "measured")
        return Error{Errc::invalid_argument,
                     "--bandwidth: nothing here is compared with the bytes it moves; leave it out"};
    Program program(options);
    const Result<void> status = on_each_backend(options, [&](auto backend) { return program.measure(backend); });
    if (!status && status.error().code == Errc::invalid_argument) return status;
    PELLUCID_CHECK(program.report());
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    return exit_status("encodings", run(argc, argv));
}
