/* Rows of ops.def by shape: a test defines ROW_<shape>(id) for the shapes that it serves, includes this for the others,
 * and then ops.def with OP(...) = ROW_##shape(id). A shape that is not listed here, and so has no test, fails to build. */
#ifndef TESTS_LRBNI_ROWS_H
#define TESTS_LRBNI_ROWS_H

#ifndef ROW_V_V
#define ROW_V_V(id)
#endif
#ifndef ROW_V_VV
#define ROW_V_VV(id)
#endif
#ifndef ROW_V_VVV
#define ROW_V_VVV(id)
#endif
#ifndef ROW_VI_V
#define ROW_VI_V(id)
#endif
#ifndef ROW_VI_VV
#define ROW_VI_VV(id)
#endif
#ifndef ROW_VD_V
#define ROW_VD_V(id)
#endif
#ifndef ROW_VD_VV
#define ROW_VD_VV(id)
#endif
#ifndef ROW_VD_VVV
#define ROW_VD_VVV(id)
#endif
#ifndef ROW_KD_VV
#define ROW_KD_VV(id)
#endif
#ifndef ROW_V_KVV
#define ROW_V_KVV(id)
#endif
#ifndef ROW_VD_KVV
#define ROW_VD_KVV(id)
#endif
#ifndef ROW_V_VX
#define ROW_V_VX(id)
#endif
#ifndef ROW_VK_VV
#define ROW_VK_VV(id)
#endif
#ifndef ROW_C_M
#define ROW_C_M(id)
#endif
#ifndef ROW_M_C
#define ROW_M_C(id)
#endif
#ifndef ROW_V_VII
#define ROW_V_VII(id)
#endif
#ifndef ROW_V_M
#define ROW_V_M(id)
#endif
#ifndef ROW_VI_M
#define ROW_VI_M(id)
#endif
#ifndef ROW_M_V
#define ROW_M_V(id)
#endif
#ifndef ROW_M_VI
#define ROW_M_VI(id)
#endif
#ifndef ROW_VD_M
#define ROW_VD_M(id)
#endif
#ifndef ROW_VQ_M
#define ROW_VQ_M(id)
#endif
#ifndef ROW_M_VD
#define ROW_M_VD(id)
#endif
#ifndef ROW_M_VQ
#define ROW_M_VQ(id)
#endif
#ifndef ROW_ML_V
#define ROW_ML_V(id)
#endif
#ifndef ROW_ML_VD
#define ROW_ML_VD(id)
#endif
#ifndef ROW_V_MC
#define ROW_V_MC(id)
#endif
#ifndef ROW_VI_MC
#define ROW_VI_MC(id)
#endif
#ifndef ROW_MC_V
#define ROW_MC_V(id)
#endif
#ifndef ROW_MC_VI
#define ROW_MC_VI(id)
#endif
#ifndef ROW_V_MS
#define ROW_V_MS(id)
#endif
#ifndef ROW_VI_MS
#define ROW_VI_MS(id)
#endif
#ifndef ROW_VD_MS
#define ROW_VD_MS(id)
#endif
#ifndef ROW_VQ_MS
#define ROW_VQ_MS(id)
#endif
#ifndef ROW_MS_V
#define ROW_MS_V(id)
#endif
#ifndef ROW_MS_VI
#define ROW_MS_VI(id)
#endif
#ifndef ROW_MS_VD
#define ROW_MS_VD(id)
#endif
#ifndef ROW_MS_VQ
#define ROW_MS_VQ(id)
#endif
#ifndef ROW_V_MSC
#define ROW_V_MSC(id)
#endif
#ifndef ROW_VI_MSC
#define ROW_VI_MSC(id)
#endif
#ifndef ROW_MSC_V
#define ROW_MSC_V(id)
#endif
#ifndef ROW_MSC_VI
#define ROW_MSC_VI(id)
#endif
#ifndef ROW_V_MVI
#define ROW_V_MVI(id)
#endif
#ifndef ROW_VI_MVI
#define ROW_VI_MVI(id)
#endif
#ifndef ROW_VD_MVI
#define ROW_VD_MVI(id)
#endif
#ifndef ROW_VQ_MVI
#define ROW_VQ_MVI(id)
#endif
#ifndef ROW_MVI_V
#define ROW_MVI_V(id)
#endif
#ifndef ROW_MVI_VI
#define ROW_MVI_VI(id)
#endif
#ifndef ROW_MVI_VD
#define ROW_MVI_VD(id)
#endif
#ifndef ROW_MVI_VQ
#define ROW_MVI_VQ(id)
#endif
#ifndef ROW_H_MVI
#define ROW_H_MVI(id)
#endif
#ifndef ROW_H_VIM
#define ROW_H_VIM(id)
#endif
#ifndef ROW_K_VV
#define ROW_K_VV(id)
#endif
#ifndef ROW_KI_VV
#define ROW_KI_VV(id)
#endif
#ifndef ROW_K_KK
#define ROW_K_KK(id)
#endif
#ifndef ROW_K_K
#define ROW_K_K(id)
#endif
#ifndef ROW_F_KK
#define ROW_F_KK(id)
#endif
#ifndef ROW_K_R
#define ROW_K_R(id)
#endif
#ifndef ROW_R_K
#define ROW_R_K(id)
#endif
#ifndef ROW_R_R
#define ROW_R_R(id)
#endif
#ifndef ROW_R_RR
#define ROW_R_RR(id)
#endif
#ifndef ROW_R_RI
#define ROW_R_RI(id)
#endif
#ifndef ROW_P_PR
#define ROW_P_PR(id)
#endif
#ifndef ROW_R_M
#define ROW_R_M(id)
#endif
#ifndef ROW_M_R
#define ROW_M_R(id)
#endif
#ifndef ROW_F_RR
#define ROW_F_RR(id)
#endif
#ifndef ROW_B_F
#define ROW_B_F(id)
#endif
#ifndef ROW_B
#define ROW_B(id)
#endif
#ifndef ROW_H_M
#define ROW_H_M(id)
#endif
#ifndef ROW_H_R
#define ROW_H_R(id)
#endif
#ifndef ROW_VI_ps_II
#define ROW_VI_ps_II(id)
#endif
#ifndef ROW_V_pi_II
#define ROW_V_pi_II(id)
#endif
#ifndef ROW_V_V_II
#define ROW_V_V_II(id)
#endif
#ifndef ROW_VD_V_II
#define ROW_VD_V_II(id)
#endif
#ifndef ROW_V_V_NS
#define ROW_V_V_NS(id)
#endif
#ifndef ROW_VD_V_NS
#define ROW_VD_V_NS(id)
#endif
#ifndef ROW_VD_ps
#define ROW_VD_ps(id)
#endif
#ifndef ROW_VD_pi
#define ROW_VD_pi(id)
#endif
#ifndef ROW_V_pd_I
#define ROW_V_pd_I(id)
#endif
#ifndef ROW_VI_pd_I
#define ROW_VI_pd_I(id)
#endif
#ifndef ROW_V_Vpd_I
#define ROW_V_Vpd_I(id)
#endif
#ifndef ROW_VI_Vpd_I
#define ROW_VI_Vpd_I(id)
#endif
#ifndef ROW_VI_ps
#define ROW_VI_ps(id)
#endif
#ifndef ROW_V_pi
#define ROW_V_pi(id)
#endif
#ifndef ROW_VI_Vps_I
#define ROW_VI_Vps_I(id)
#endif
#ifndef ROW_V_Vpi
#define ROW_V_Vpi(id)
#endif
#ifndef ROW_V_VV_I
#define ROW_V_VV_I(id)
#endif
#ifndef ROW_V_VVpi
#define ROW_V_VVpi(id)
#endif
#ifndef ROW_VD_VVpq
#define ROW_VD_VVpq(id)
#endif
#ifndef ROW_MARK
#define ROW_MARK(id)
#endif
#ifndef ROW_VI_VVV
#define ROW_VI_VVV(id)
#endif
#ifndef ROW_VI_VX
#define ROW_VI_VX(id)
#endif
#ifndef ROW_VI_VI
#define ROW_VI_VI(id)
#endif
#ifndef ROW_VI_VIII
#define ROW_VI_VIII(id)
#endif
#ifndef ROW_VI_VVIII
#define ROW_VI_VVIII(id)
#endif
#ifndef ROW_VIK_VKV
#define ROW_VIK_VKV(id)
#endif
#ifndef ROW_VIK_V
#define ROW_VIK_V(id)
#endif
#ifndef ROW_VIK_VV
#define ROW_VIK_VV(id)
#endif
#ifndef ROW_VI_KVV
#define ROW_VI_KVV(id)
#endif
#ifndef ROW_VQ_V
#define ROW_VQ_V(id)
#endif
#ifndef ROW_VQ_VV
#define ROW_VQ_VV(id)
#endif
#ifndef ROW_VQ_KVV
#define ROW_VQ_KVV(id)
#endif
#ifndef ROW_VI_XII
#define ROW_VI_XII(id)
#endif
#ifndef ROW_VI_XI
#define ROW_VI_XI(id)
#endif
#ifndef ROW_V_XI
#define ROW_V_XI(id)
#endif
#ifndef ROW_VI_XX
#define ROW_VI_XX(id)
#endif
#ifndef ROW_VI_XXI
#define ROW_VI_XXI(id)
#endif
#ifndef ROW_R_KK
#define ROW_R_KK(id)
#endif
#ifndef ROW_K_RI
#define ROW_K_RI(id)
#endif
#ifndef ROW_B_K
#define ROW_B_K(id)
#endif
#ifndef ROW_R_RIII
#define ROW_R_RIII(id)
#endif
#ifndef ROW_R_RRIII
#define ROW_R_RRIII(id)
#endif

#endif
