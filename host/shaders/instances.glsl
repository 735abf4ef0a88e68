// Which instances are drawn: the slot of each visible one. A slot is no drawn index once an instance is hidden or destroyed.
layout(set = 1, binding = kInstancesBinding, std430) readonly buffer Instances { uint instanceSlots[]; };
