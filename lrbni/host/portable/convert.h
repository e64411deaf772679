/* Conversions, exponents and transcendentals in plain C: the shared loops, all of them. */
#ifndef LRBNI_HOST_PORTABLE_CONVERT_H
#define LRBNI_HOST_PORTABLE_CONVERT_H

#include "lrbni/host/portable/arith.h"

#include "lrbni/host/common/each_lane.h"

#define lanes_cvtps2pi lanes_each_cvtps2pi
#define lanes_cvtps2pu lanes_each_cvtps2pu
#define lanes_cvtpi2ps lanes_each_cvtpi2ps
#define lanes_cvtpu2ps lanes_each_cvtpu2ps
#define lanes_cvtpd2ps lanes_each_cvtpd2ps
#define lanes_cvtpd2pi lanes_each_cvtpd2pi
#define lanes_cvtpd2pu lanes_each_cvtpd2pu
#define lanes_cvtps2pd lanes_each_cvtps2pd
#define lanes_cvtpi2pd lanes_each_cvtpi2pd
#define lanes_cvtpu2pd lanes_each_cvtpu2pd
#define lanes_round_ps lanes_each_round_ps
#define lanes_round_pd lanes_each_round_pd
#define lanes_getexp_ps lanes_each_getexp_ps
#define lanes_getexp_pd lanes_each_getexp_pd
#define lanes_getmant_ps lanes_each_getmant_ps
#define lanes_getmant_pd lanes_each_getmant_pd
#define lanes_scale_ps lanes_each_scale_ps
#define lanes_rcp23_ps lanes_each_rcp23_ps
#define lanes_rsqrt23_ps lanes_each_rsqrt23_ps

#endif
