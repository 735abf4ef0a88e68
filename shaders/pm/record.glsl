// The records of P_m's patches, word by word (shared/pm.h). Needs tables.glsl.
uint pointWord(uint record, uint i) { return tableWord(4u * record + SUPPLE_PM_POINT_WORD(i)); }
uint spokeWord(uint record, uint i) { return tableWord(4u * record + SUPPLE_PM_SPOKE_WORD(i)); }
uint innerWord(uint record, uint m) { return tableWord(4u * record + SUPPLE_PM_INNER_WORD(m)); }
uint classWord(uint record, uint m, uint i) { return tableWord(4u * record + SUPPLE_PM_CLASS_WORD(m, i)); }

uint pointIndex(uint record, uint i) { return SUPPLE_POINT(pointWord(record, i)); }
uint centreIndex(uint record, uint m) { return SUPPLE_INNER(innerWord(record, m)); }
