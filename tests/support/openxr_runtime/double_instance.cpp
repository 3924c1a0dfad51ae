#include <cstdio>
#include <cstring>

#include "tests/support/openxr_runtime/double_state.h"

namespace orthonav::test {
namespace {

const XrInstance kInstance = reinterpret_cast<XrInstance>(std::uintptr_t{0x1157a9ce});
constexpr XrSystemId kSystem = 77;

XrResult XRAPI_CALL enumerate_extensions(const char* layer, std::uint32_t capacity,
                                         std::uint32_t* count, XrExtensionProperties* properties) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  std::vector<XrExtensionProperties> all;
  const auto add = [&](const char* name, std::uint32_t version) {
    XrExtensionProperties property = {XR_TYPE_EXTENSION_PROPERTIES};
    std::snprintf(property.extensionName, sizeof(property.extensionName), "%s", name);
    property.extensionVersion = version;
    all.push_back(property);
  };
  if (layer != nullptr) {
    return XR_ERROR_API_LAYER_NOT_PRESENT;
  }
  add(XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME, 2);
  if (d.traits.converts_time) {
    add(XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME, 1);
  }
  if (d.traits.takes_depth) {
    add(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME, 5);
  }
  if (d.traits.hand_interaction) {
    add(kHandInteraction, 1);
  }
  if (d.traits.hand_tracking) {
    add(XR_EXT_HAND_TRACKING_EXTENSION_NAME, 4);
  }
  if (d.traits.eye_gaze) {
    add(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME, 1);
  }
  return enumerate(all, capacity, count, properties);
}

XrResult XRAPI_CALL create_instance(const XrInstanceCreateInfo* info, XrInstance* instance) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  take_script(d);
  if (d.instance) {
    return XR_ERROR_LIMIT_REACHED;
  }
  if (d.refusals > 0) {
    --d.refusals;
    return XR_ERROR_RUNTIME_FAILURE;
  }
  std::set<std::string> enabled;
  for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
    const std::string name = info->enabledExtensionNames[i];
    if (name != XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME &&
        name != XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME &&
        !(d.traits.takes_depth && name == XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME) &&
        !(d.traits.hand_interaction && name == kHandInteraction) &&
        !(d.traits.hand_tracking && name == XR_EXT_HAND_TRACKING_EXTENSION_NAME) &&
        !(d.traits.eye_gaze && name == XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME)) {
      return d.violated("extension " + name + " was not offered", XR_ERROR_EXTENSION_NOT_PRESENT);
    }
    enabled.insert(name);
  }
  d.enabled = std::move(enabled);
  d.instance = true;
  d.instance_lost = false;
  d.requirements_asked = false;
  d.events.clear();
  ++d.instance_count;
  *instance = kInstance;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroy_instance(XrInstance) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  d.instance = false;
  // Destroying an instance destroys its children; a tidy application destroys them first.
  if (d.session && !d.instance_lost) {
    d.violated("the instance went before its session", XR_SUCCESS);
  }
  d.session.reset();
  write_report(d);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL instance_properties(XrInstance, XrInstanceProperties* properties) {
  properties->runtimeVersion = XR_MAKE_VERSION(0, 1, 0);
  std::snprintf(properties->runtimeName, sizeof(properties->runtimeName), "orthonav's double");
  return XR_SUCCESS;
}

XrResult XRAPI_CALL poll_event(XrInstance, XrEventDataBuffer* event) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (d.instance_lost) {
    return XR_ERROR_INSTANCE_LOST;
  }
  if (d.events.empty()) {
    return XR_EVENT_UNAVAILABLE;
  }
  *event = d.events.front();
  d.events.pop_front();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL result_to_string(XrInstance, XrResult value, char* text) {
  std::snprintf(text, XR_MAX_RESULT_STRING_SIZE, "%d", static_cast<int>(value));
  return XR_SUCCESS;
}

XrResult XRAPI_CALL get_system(XrInstance, const XrSystemGetInfo* info, XrSystemId* system) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (d.instance_lost) {
    return XR_ERROR_INSTANCE_LOST;
  }
  if (info->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY) {
    return XR_ERROR_FORM_FACTOR_UNSUPPORTED;
  }
  if (!d.traits.headset) {
    return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  }
  *system = kSystem;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL system_properties(XrInstance, XrSystemId, XrSystemProperties* properties) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  properties->systemId = kSystem;
  std::snprintf(properties->systemName, sizeof(properties->systemName), "scripted headset");
  properties->graphicsProperties = {4096, 4096, d.traits.most_composition_layers};
  for (auto* next = static_cast<XrBaseOutStructure*>(properties->next); next != nullptr;
       next = next->next) {
    if (next->type == XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT &&
        d.enabled.count(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME) > 0) {
      reinterpret_cast<XrSystemEyeGazeInteractionPropertiesEXT*>(next)->supportsEyeGazeInteraction =
          d.traits.sees_eyes ? XR_TRUE : XR_FALSE;
    } else if (next->type == XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT &&
               d.enabled.count(XR_EXT_HAND_TRACKING_EXTENSION_NAME) > 0) {
      reinterpret_cast<XrSystemHandTrackingPropertiesEXT*>(next)->supportsHandTracking =
          d.traits.sees_hands ? XR_TRUE : XR_FALSE;
    } else {
      return d.violated("properties of what was not switched on", XR_ERROR_VALIDATION_FAILURE);
    }
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL blend_modes(XrInstance, XrSystemId, XrViewConfigurationType,
                                std::uint32_t capacity, std::uint32_t* count,
                                XrEnvironmentBlendMode* modes) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  return enumerate(d.traits.blends, capacity, count, modes);
}

XrResult XRAPI_CALL view_configurations(XrInstance, XrSystemId, std::uint32_t capacity,
                                        std::uint32_t* count, XrViewConfigurationType* types) {
  return enumerate(std::vector<XrViewConfigurationType>{XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO},
                   capacity, count, types);
}

XrResult XRAPI_CALL configuration_views(XrInstance, XrSystemId, XrViewConfigurationType type,
                                        std::uint32_t capacity, std::uint32_t* count,
                                        XrViewConfigurationView* views) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (d.instance_lost) {
    return XR_ERROR_INSTANCE_LOST;
  }
  if (type != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) {
    return XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
  }
  XrViewConfigurationView view = {XR_TYPE_VIEW_CONFIGURATION_VIEW};
  view.recommendedImageRectWidth = d.traits.width_px;
  view.recommendedImageRectHeight = d.traits.height_px;
  view.maxImageRectWidth = view.maxImageRectHeight = 4096;
  view.recommendedSwapchainSampleCount = view.maxSwapchainSampleCount = 1;
  return enumerate(std::vector<XrViewConfigurationView>(2, view), capacity, count, views);
}

XrResult XRAPI_CALL time_from_timespec(XrInstance, const timespec* monotonic, XrTime* time) {
  Double& d = the_double();
  const std::lock_guard lock(d.mutex);
  if (d.instance_lost) {
    return XR_ERROR_INSTANCE_LOST;
  }
  timespec real = {};
  ::clock_gettime(CLOCK_MONOTONIC, &real);
  const auto count = [](const timespec& t) { return t.tv_sec * 1'000'000'000 + t.tv_nsec; };
  *time = d.now() + (d.traits.stepped ? 0 : count(*monotonic) - count(real));
  return XR_SUCCESS;
}

XrResult XRAPI_CALL get_proc(XrInstance, const char* name, PFN_xrVoidFunction* function) {
  *function = function_named(name);
  // Functions of an extension are there once it is enabled.
  if (std::strstr(name, "HandTracker") != nullptr || std::strstr(name, "HandJoints") != nullptr) {
    Double& d = the_double();
    const std::lock_guard lock(d.mutex);
    if (d.enabled.count(XR_EXT_HAND_TRACKING_EXTENSION_NAME) == 0) {
      *function = nullptr;
    }
  }
  return *function != nullptr ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

// The interface between the loader and a runtime; Debian ships no header for it.
struct LoaderInfo {
  int type;
  std::uint32_t version;
  std::size_t size;
  std::uint32_t least_interface;
  std::uint32_t most_interface;
  XrVersion least_api;
  XrVersion most_api;
};
struct RuntimeRequest {
  int type;
  std::uint32_t version;
  std::size_t size;
  std::uint32_t interface;
  XrVersion api;
  PFN_xrGetInstanceProcAddr get_proc;
};

}  // namespace

void add_instance_functions(std::map<std::string, PFN_xrVoidFunction>& table) {
  table["xrGetInstanceProcAddr"] = as_void(get_proc);
  table["xrEnumerateInstanceExtensionProperties"] = as_void(enumerate_extensions);
  table["xrCreateInstance"] = as_void(create_instance);
  table["xrDestroyInstance"] = as_void(destroy_instance);
  table["xrGetInstanceProperties"] = as_void(instance_properties);
  table["xrPollEvent"] = as_void(poll_event);
  table["xrResultToString"] = as_void(result_to_string);
  table["xrGetSystem"] = as_void(get_system);
  table["xrGetSystemProperties"] = as_void(system_properties);
  table["xrEnumerateEnvironmentBlendModes"] = as_void(blend_modes);
  table["xrEnumerateViewConfigurations"] = as_void(view_configurations);
  table["xrEnumerateViewConfigurationViews"] = as_void(configuration_views);
  table["xrConvertTimespecTimeToTimeKHR"] = as_void(time_from_timespec);
}

PFN_xrVoidFunction function_named(const std::string& name) {
  static const std::map<std::string, PFN_xrVoidFunction> kTable = [] {
    std::map<std::string, PFN_xrVoidFunction> table;
    add_instance_functions(table);
    add_vulkan_functions(table);
    add_session_functions(table);
    add_swapchain_functions(table);
    add_frame_functions(table);
    add_input_functions(table);
    add_hand_functions(table);
    return table;
  }();
  const auto found = kTable.find(name);
  return found == kTable.end() ? nullptr : found->second;
}

extern "C" XrResult xrNegotiateLoaderRuntimeInterface(const LoaderInfo* loader,
                                                      RuntimeRequest* request);
extern "C" XrResult xrNegotiateLoaderRuntimeInterface(const LoaderInfo* loader,
                                                      RuntimeRequest* request) {
  constexpr std::uint32_t kInterface = 1;
  if (loader == nullptr || request == nullptr || loader->least_interface > kInterface) {
    return XR_ERROR_INITIALIZATION_FAILED;
  }
  request->interface = kInterface;
  request->api = XR_CURRENT_API_VERSION;
  request->get_proc = get_proc;
  return XR_SUCCESS;
}

}  // namespace orthonav::test
