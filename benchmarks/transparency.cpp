// SPDX-License-Identifier: MIT
// Time against error for every way of drawing translucent surfaces, on any scene: whole frames, in turn, against the
// double-precision reference.
//
//     transparency [--scene NAME|FILE.gltf ...] [--method NAME ...] [--backend vulkan|opengl|both] [--device N|name]
//                  [--size WxH] [--rounds N] [--json FILE] [--svg FILE] [--markdown FILE] [--quick]
//                  [--clock auto|timestamps|wall] [--peers auto|no]
//
// Scenes: S1 S2 S3 L1 (files, from the folder that PELLUCID_SCENES names or beside the program), demo, teapots (a
// million triangles), peeling, chain, planes, quads, glass, or any glTF file.
//
// Exit status: 0 measured; 1 a result was wrong or a device failed; 2 usage; 4 no device.
#include <map>
#include <tuple>
#include "support/pass_program.hpp"
#include "transparency/measure.hpp"
#include "transparency/report.hpp"
#include "transparency/vtk.hpp"

namespace {

using namespace pellucid;
using namespace pellucid::bench;

Options transparency_options() {
    return Options({{"backend", "both"},
                    {"device", ""},
                    {"size", "auto"},
                    {"rounds", "auto"},
                    {"clock", "auto"},
                    {"peers", "auto"},
                    {"json", ""},
                    {"svg", ""},
                    {"markdown", ""}},
                   {"quick"}, {"scene", "method"});
}

/// The methods by name, all where none is named; the baseline always, and first.
Result<std::vector<Method>> chosen_methods(const std::vector<std::string>& names) {
    std::vector<Method> out = {methods[0]};
    std::string known;
    for (const Method& method : methods) known += std::string(known.empty() ? "" : ", ") + name(method.value);
    for (const std::string& wanted : names)
        if (std::none_of(std::begin(methods), std::end(methods),
                         [&](const Method& method) { return wanted == name(method.value); }))
            return Error{Errc::invalid_argument, "--method '" + wanted + "' is none of " + known};
    for (const Method& method : methods)
        if (method.value != methods[0].value &&
            (names.empty() || std::find(names.begin(), names.end(), name(method.value)) != names.end()))
            out.push_back(method);
    return out;
}

/// Scenes and references outlive a backend: both compare with the same.
class Program {
public:
    Result<void> run(int argc, char** argv) {
        PELLUCID_CHECK(options_.parse(argc, argv));
        const std::string& peers = options_.text("peers");
        if (peers != "auto" && peers != "no")
            return Error{Errc::invalid_argument, "--peers is '" + peers + "' but must be auto or no"};
        PELLUCID_TRY(methods_, chosen_methods(options_.list("method")));
        names_ = options_.list("scene");
        by_default_ = names_.empty();
        if (by_default_)
            names_ = options_.flag("quick") ? std::vector<std::string>{"planes", "glass"}
                                            : std::vector<std::string>{"S1", "S2", "S3", "L1", "demo", "teapots"};
        const Result<void> status =
            on_each_backend(options_, [&]<class B>(std::type_identity<B>) -> Result<void> { return measure_on<B>(); });
        PELLUCID_CHECK(write_files());
        return status;
    }

private:
    template <rhi::Backend B>
    Result<void> measure_on() {
        std::unique_ptr<rhi::DeviceFor<B>> device;
        PELLUCID_TRY(device, B::create({.device = options_.text("device")}));
        BackendResult result{.device = device->info(), .machine = describe_machine()};
        const bool quick = options_.flag("quick"), software = result.device.software;
        PELLUCID_TRY(result.size, size_option(options_, quick      ? Extent2D{64, 64}
                                                        : software ? Extent2D{512, 512}
                                                                   : Extent2D{1920, 1080}));
        PELLUCID_TRY(result.timestamps, timestamps_option(options_, result.device));
        result.rounds = quick ? 3 : software ? 9 : 31;
        result.warm_up = quick ? 1 : software ? 2 : 5;
        if (options_.text("rounds") != "auto") {
            PELLUCID_TRY(result.rounds, options_.number("rounds", 1, 10000));
        }
        std::string vtk;
        if (options_.text("peers") == "auto" && !quick) {
            if (!software) {
                result.notes.push_back("VTK is not measured: it would draw on the processor, and we on a GPU");
            } else if (const Result<std::string> found = find_vtk()) {
                vtk = *found;
            } else {
                result.notes.push_back(found.error().message);
            }
        }
        PELLUCID_CHECK(load_scenes(result));
        say(heading(result) + "\n");
        // What was measured before an error is reported.
        Result<void> status;
        for (const std::string& name : names_) {
            const auto found = cases_.find(name);
            if (found == cases_.end()) continue;
            if (status = measure_one<B>(*device, found->second, result, vtk); !status) break;
        }
        results_.push_back(std::move(result));
        return status;
    }

    template <rhi::Backend B>
    Result<void> measure_one(rhi::DeviceFor<B>& device, const Case& c, BackendResult& result, const std::string& vtk) {
        PELLUCID_TRY(const Truth* truth, truth_of(c, result.size, !device.info().software));
        if (truth->max_layers == 0) {
            say("#### " + c.title + "\n\nNo translucent surface is seen: nothing to compare.\n\n");
            return {};
        }
        std::vector<std::unique_ptr<Peer>> peers;
        std::vector<std::string> notes;
        for (const char* method : {"dual-peel", "plain"}) {
            if (vtk.empty() || !c.peers) continue;
            if (auto peer = VtkScene::open(vtk, c, *truth, method))
                peers.push_back(std::move(*peer));
            else
                notes.push_back(std::string("VTK ") + method + " is not measured: " + peer.error().message);
        }
        PELLUCID_TRY(SceneResult scene, measure_scene<B>(device, c, *truth,
                                                         {.size = result.size,
                                                          .methods = methods_,
                                                          .timestamps = result.timestamps,
                                                          .rounds = result.rounds,
                                                          .warm_up = result.warm_up},
                                                         peers));
        scene.notes.insert(scene.notes.end(), notes.begin(), notes.end());
        say(to_markdown(scene) + "\n");
        result.scenes.push_back(std::move(scene));
        return {};
    }

    /// Loads what is not loaded yet; a default scene that is not there is left out with a note.
    Result<void> load_scenes(BackendResult& result) {
        for (const std::string& name : names_) {
            if (cases_.contains(name)) continue;
            Result<Case> loaded = load_case(name, result.size);
            if (loaded)
                cases_.emplace(name, std::move(*loaded));
            else if (by_default_ && loaded.error().code == Errc::io)
                result.notes.push_back(loaded.error().message);
            else
                return loaded.error();
        }
        return {};
    }

    Result<const Truth*> truth_of(const Case& c, Extent2D size, bool on_grid) {
        const auto key = std::make_tuple(&c, size.width, size.height, on_grid);
        auto found = truths_.find(key);
        if (found == truths_.end()) {
            PELLUCID_TRY(Truth truth, make_truth(c, size, on_grid));
            found = truths_.emplace(key, std::move(truth)).first;
        }
        return &found->second;
    }

    void say(const std::string& text) {
        std::printf("%s", text.c_str());
        std::fflush(stdout);
        markdown_ += text;
    }

    Result<void> write_files() {
        if (results_.empty()) return {};
        if (const std::string& file = options_.text("markdown"); !file.empty())
            PELLUCID_CHECK(write_file(file, markdown_));
        if (const std::string& file = options_.text("json"); !file.empty()) {
            JsonWriter json;
            json.begin_array();
            for (const BackendResult& result : results_) write(json, result);
            json.end_array();
            PELLUCID_CHECK(write_file(file, json.text()));
        }
        if (const std::string& file = options_.text("svg"); !file.empty())
            for (const BackendResult& result : results_)
                PELLUCID_CHECK(write_file(with_suffix(file, result.device.backend), to_svg(to_sheet(result))));
        return {};
    }

    Options options_ = transparency_options();
    std::vector<Method> methods_;
    std::vector<std::string> names_;
    bool by_default_ = false;
    std::map<std::string, Case> cases_;  ///< by what `--scene` calls them
    std::map<std::tuple<const Case*, std::uint32_t, std::uint32_t, bool>, Truth> truths_;  ///< by case, size, grid
    std::vector<BackendResult> results_;
    std::string markdown_;
};

}  // namespace

int main(int argc, char** argv) {
    return exit_status("transparency", Program().run(argc, argv));
}
