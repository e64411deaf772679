/* Finds and loads the module that writes pictures; image_writer.h says where it is looked for. */
#ifndef REPORTS_IMAGE_MODULE_LOADER_H
#define REPORTS_IMAGE_MODULE_LOADER_H

#include "reports/image_module.h"

/** Load the module, once; later calls find it loaded. Errors: BASE_ERR_UNSUPPORTED, saying what is missing. */
base_status report_image_module_load(report_image_encode_fn **encode, base_error *err);

#endif
