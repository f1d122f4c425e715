# pellucid-render against the reference renderer: --reference draws, --compare reference judges.
#   cmake -DTOOL= -DGENERATE= -DBACKEND= -DWORK= -P reference.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect.cmake)
if(no_device)
  return()
endif()
make_scene(sheets)
make_scene(intersecting_planes)
make_scene(lit_glass)
set(stats ${WORK}/stats.json)

# Its pictures and statistics.
set(small ${sheets} --size 64x48)
run(0 "^reference on the CPU: 64x48, .*sheets.pfm" ${small} --reference --out ${WORK}/sheets.pfm --stats ${stats})
field(${stats} reference backend)
field(${stats} reference translucency method)
field(${stats} ON translucency exact)
field(${stats} 3072 translucency layers histogram 3)
field(${stats} 9216 translucency fragments)
run(0 "reference on the CPU" ${small} --reference --out ${WORK}/sheets.png)
run(0 "bit for bit equal" ${small} --reference --compare ${WORK}/sheets.pfm --error-budget 0)
run(0 "display values.*bit for bit equal" ${small} --reference --compare ${WORK}/sheets.png --error-budget 0)
run(6 "is not within the error budget" ${small} --reference --transparency none --compare ${WORK}/sheets.pfm
  --error-budget 0.01)
expect(0 "display values" ${small} --compare ${WORK}/sheets.png --error-budget 0.002)  # half a code of 255

# Unlit colours are within half a unit of binary16 a store, lit ones within what 8-bit base colour and 16-bit normals
# of the G-buffer make of them.
expect(0 "against .*sheets.pfm" ${small} --compare ${WORK}/sheets.pfm --error-budget 0.0005)
expect(0 "against the reference: 64 x 64 pixels, [0-9]+ compared, [0-9]+ left out" ${intersecting_planes} --size 64x64
  --compare reference --error-budget 0.0005 --audit)
expect(0 "against the reference" ${lit_glass} --size 64x64 --compare reference --error-budget 0.002
  --stats ${stats} --heatmap ${WORK}/heat.png)
field(${stats} reference comparison with)
field(${stats} linear comparison values)
field(${stats} 0.002 comparison error_budget)
field(${stats} ON comparison within_budget)
foreach(metric ssim ldr_flip hdr_flip tone_mapped_psnr scaled layers coverage)
  file(READ ${stats} json)
  string(JSON type ERROR_VARIABLE missing TYPE "${json}" comparison ${metric})
  if(NOT type STREQUAL "OBJECT")
    message(SEND_ERROR "the comparison has no ${metric}: ${type} ${missing}")
  endif()
endforeach()
file(READ ${WORK}/heat.png magic LIMIT 4 HEX)
if(NOT magic STREQUAL "89504e47")
  message(SEND_ERROR "the heat map is no PNG file")
endif()

# A picture that is wrong, or a budget that is too small, is status 6, and the numbers are written all the same.
expect(6 "the RMSE [0-9.e-]+ is not within the error budget 1e-06" ${intersecting_planes} --size 64x64
  --compare reference --error-budget 1e-6 --stats ${stats})
field(${stats} OFF comparison within_budget)
expect(6 "is not within the error budget 0.0005" ${intersecting_planes} --size 64x64 --transparency interleaved-skyx
  --compare reference --error-budget 0.0005)
# Without translucent surfaces both agree.
expect(0 "against the reference" ${lit_glass} --size 64x64 --transparency none --compare reference
  --error-budget 0.002)
