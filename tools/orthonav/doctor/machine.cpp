#include "tools/orthonav/doctor/machine.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/io/video_writer.h"
#include "engine/phantom/phantom.h"
#include "hal/openxr/openxr_headset.h"
#include "hal/voice/phrase_recognizer.h"
#include "render/renderer.h"

namespace orthonav::tools {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return value == nullptr ? "" : value;
}

/// The first of these files that exists; empty if none does.
std::string first_existing(const std::vector<fs::path>& candidates) {
  std::error_code ignored;
  for (const fs::path& path : candidates) {
    if (!path.empty() && fs::exists(path, ignored)) {
      return path.string();
    }
  }
  return {};
}

void add_vulkan(std::vector<Offer>& offers) {
  const std::vector<render::DeviceInfo> devices = render::list_devices();
  bool usable = false;
  for (const render::DeviceInfo& device : devices) {
    usable = usable || device.usable;
    const std::string what = device.name + ", " + device.type + ", " + device.driver;
    offers.push_back({"Vulkan device", device.usable ? Finding::kFound : Finding::kOptional,
                      device.usable ? what : what + ": " + device.reason,
                      device.usable ? "" : "a newer driver, or draw with another device"});
  }
  if (!usable) {
    offers.push_back({"Vulkan device", Finding::kMissing, "none that can draw",
                      "apt install mesa-vulkan-drivers (draws on the CPU), or the GPU's driver"});
  }
}

Offer validation_layer(const fs::path& root) {
  const std::string manifest = "VkLayer_khronos_validation.json";
  const std::string found =
      first_existing({root / "usr/share/vulkan/explicit_layer.d" / manifest,
                      root / "usr/local/share/vulkan/explicit_layer.d" / manifest,
                      root / "etc/vulkan/explicit_layer.d" / manifest});
  if (!found.empty()) {
    return {"Vulkan validation layer", Finding::kFound, found, ""};
  }
  return {"Vulkan validation layer", Finding::kOptional, "not installed; the render tests need it",
          "apt install vulkan-validationlayers"};
}

Offer openxr_runtime(const fs::path& root) {
  const std::string home = environment("HOME");
  const fs::path in_home = ".config/openxr/1/active_runtime.json";
  const std::string found = first_existing({environment("XR_RUNTIME_JSON"),
                                            home.empty() ? fs::path() : fs::path(home) / in_home,
                                            root / "etc/xdg/openxr/1/active_runtime.json",
                                            root / "usr/share/openxr/1/active_runtime.json"});
  if (found.empty()) {
    return {"OpenXR runtime", Finding::kOptional, "none active; openxr:+URI needs one",
            "install the headset's (or Monado) and name its manifest in XR_RUNTIME_JSON or "
            "~/.config/openxr/1/active_runtime.json"};
  }
  // Only the machine we run on can be queried.
  if (root != "/") {
    return {"OpenXR runtime", Finding::kFound, found, ""};
  }
  const auto runtime = openxr::describe_runtime();
  if (runtime) {
    return {"OpenXR runtime", Finding::kFound, *runtime + " (" + found + ")", ""};
  }
  return {"OpenXR runtime", Finding::kOptional, runtime.error().message,
          "start the runtime and connect the headset"};
}

Offer video_encoder() {
  const fs::path scratch =
      fs::temp_directory_path() / ("orthonav-doctor-" + std::to_string(::getpid()) + ".mp4");
  const auto writer = engine::VideoWriter::create(scratch.string(), {});
  if (writer.ok()) {
    return {"H.264 encoder", Finding::kFound, "libavcodec with libx264", ""};
  }
  return {"H.264 encoder", Finding::kMissing, writer.error().message,
          "apt install libavcodec-dev (Debian's build brings libx264)"};
}

Offer phantom_case() {
  std::string labels;
  for (const std::string& label : engine::phantom_labels()) {
    labels += " " + label;
  }
  return {"Case", Finding::kFound, "built-in phantom:" + labels, ""};
}

Offer microphone(const fs::path& root) {
  std::ifstream list(root / "proc/asound/pcm");
  for (std::string line; std::getline(list, line);) {
    if (line.find("capture") != std::string::npos) {
      return {"Microphone", Finding::kFound, line.substr(0, line.find("capture")) + "capture", ""};
    }
  }
  return {"Microphone", Finding::kOptional, "none; --voice mic: needs one, --voice wav:FILE none",
          "plug one in; the kernel lists it in /proc/asound/pcm"};
}

/// The model with which `--voice mic:` and `wav:` recognise words.
Offer voice_model(const fs::path& root) {
  const fs::path model = root / voice::default_acoustic_model().relative_path();
  if (!first_existing({model / "mdef"}).empty()) {
    return {"Voice model", Finding::kFound, model.string(), ""};
  }
  return {"Voice model", Finding::kOptional,
          model.string() + " is not there; voice commands need it",
          "apt install pocketsphinx-en-us"};
}

/// A clicker is a keyboard to the kernel: names and event devices of everything with keys.
std::vector<Offer> keyboards(const fs::path& root) {
  std::vector<Offer> found;
  std::ifstream list(root / "proc/bus/input/devices");
  std::string name;
  for (std::string line; std::getline(list, line);) {
    if (line.starts_with("N: Name=\"")) {
      name = line.substr(9, line.rfind('"') - 9);
    }
    const std::size_t event = line.find(" event");
    if (!line.starts_with("H: Handlers=") || line.find("kbd") == std::string::npos ||
        event == std::string::npos) {
      continue;
    }
    const std::string device = line.substr(event + 1, line.find(' ', event + 1) - event - 1);
    const fs::path path = root / "dev/input" / device;
    const bool readable = ::access(path.c_str(), R_OK) == 0;
    found.push_back({"Clicker or keyboard", readable ? Finding::kFound : Finding::kOptional,
                     name + ", " + path.string() + (readable ? "" : ": no permission to read"),
                     readable ? "" : "usermod -aG input $USER, then log in again"});
  }
  return found;
}

}  // namespace

std::vector<Offer> offers_of_machine(const std::string& root) {
  std::vector<Offer> offers;
  add_vulkan(offers);
  offers.push_back(validation_layer(root));
  offers.push_back(video_encoder());
  offers.push_back(phantom_case());
  offers.push_back(
      {"Headset", Finding::kFound,
       "sim: (simulated), replay:PATH (recorded), hl2ss://HOST, openxr:+URI, igtl://HOST "
       "(tools that another program tracks)",
       ""});
  offers.push_back(openxr_runtime(root));
  offers.push_back(microphone(root));
  offers.push_back(voice_model(root));
  std::vector<Offer> clickers = keyboards(root);
  if (clickers.empty()) {
    clickers.push_back({"Clicker or keyboard", Finding::kOptional,
                        "none; --clicker evdev: needs one (the simulated surgeon has their own)",
                        "pair a Bluetooth clicker or plug in a keyboard"});
  }
  std::move(clickers.begin(), clickers.end(), std::back_inserter(offers));
  return offers;
}

}  // namespace orthonav::tools
