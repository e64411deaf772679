/* Ids, names and meanings of the cost classes in cost_classes.def. */
#ifndef LRBNI_COST_CLASSES_H
#define LRBNI_COST_CLASSES_H

typedef enum lrb_cost_class {
#define CLASS(id, sentence) LRB_CLASS_##id, /* LRB_CLASS_vector_alu, */
#include "lrbni/cost_classes.def"
    LRB_CLASS_COUNT
} lrb_cost_class;

typedef struct lrb_cost_class_info {
    const char *name;
    const char *sentence;
} lrb_cost_class_info;

static const lrb_cost_class_info lrb_cost_classes[LRB_CLASS_COUNT] = {
#define CLASS(id, sentence) {#id, sentence}, /* {"vector_alu", "16-lane float ..."}, */
#include "lrbni/cost_classes.def"
};

#endif
