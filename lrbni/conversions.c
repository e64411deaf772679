#include "lrbni/conversions.h"

/* {"ps", "float16", 2, LRB_CHIPS_LK, LRB_CHIPS_LK, "MIC.H, ODB", "d = the half m"}, */
#define UP_ROW(lanes, id, bytes, chips, s3, source, formula) {lanes, #id, bytes, LRB_CHIPS_##chips, LRB_CHIPS_##s3, source, formula},
#define DOWN_ROW(lanes, id, bytes, chips, source, formula) {lanes, #id, bytes, LRB_CHIPS_##chips, LRB_CHIPS_NONE, source, formula},

const lrb_conversion lrb_ups[] = {
#define UP_PS(...) UP_ROW("ps", __VA_ARGS__)
#define UP_PI(...) UP_ROW("pi", __VA_ARGS__)
#define UP_PD(...) UP_ROW("pd", __VA_ARGS__)
#define UP_PQ(...) UP_ROW("pq", __VA_ARGS__)
#include "lrbni/conversions.def"
};

const lrb_conversion lrb_downs[] = {
#define DOWN_PS(...) DOWN_ROW("ps", __VA_ARGS__)
#define DOWN_PI(...) DOWN_ROW("pi", __VA_ARGS__)
#define DOWN_PD(...) DOWN_ROW("pd", __VA_ARGS__)
#define DOWN_PQ(...) DOWN_ROW("pq", __VA_ARGS__)
#include "lrbni/conversions.def"
};
