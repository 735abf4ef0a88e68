// What the validation layer says, with SUPPLE_VALIDATION=1: printed, and counted for the exit code.
#pragma once

#include "vk.h"

#include <QVulkanInstance>

namespace qt_quick {

bool validationWanted();
/// Before instance.create(): the layer, with synchronization validation.
void askForValidation(QVulkanInstance& instance);
/// After it: who listens. The instance owns nothing of it: call stopListening before it goes.
VkDebugUtilsMessengerEXT listen(VkInstance instance);
void stopListening(VkInstance instance, VkDebugUtilsMessengerEXT messenger);
/// Without those that are Qt's own.
int validationMessages();

} // namespace qt_quick
