# Options of transparency that cannot be heeded: refused with what is needed and what there is, never ignored.
#   cmake -DTOOL= -DGENERATE= -DBACKEND= -DWORK= -P refusals.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect.cmake)
if(no_device)
  return()
endif()
make_scene(sheets)
set(asked ${sheets} --size 64x48 ${none})
set(peel --transparency peel)

# Values.
foreach(layers 0 -1 x 2x 65536 1e3)
  expect(2 "--layers: '${layers}' is not a number of layers: write a whole number from 1 to 65535" ${asked} ${peel}
    --layers=${layers})
endforeach()
foreach(budget 0 0K -1 x 1T 1.5M 20000000000G 99999999999999999999)
  expect(2 "--memory-budget: '${budget}' is not a number of bytes: write a whole number above 0, with K, M or G" ${asked}
    --memory-budget=${budget})
endforeach()
foreach(share 1 1.5 -0.1 nan inf x 0.5x)
  expect(2 "--min-transmittance: '${share}' is not a share of light to stop at: write a number from 0 to below 1" ${asked}
    --min-transmittance=${share})
endforeach()
expect(2 "--transparency: magic not in .auto,none,sorted,.*abuffer" ${asked} --transparency magic)

expect(2 "--lighting: Check forward value in .auto" ${asked} --lighting forward)
expect(2 "--environment is none, sky or a FILE.hdr, not 'stars'" ${asked} --environment stars)
expect(3 "none.hdr: there is no such file" ${asked} --environment ${WORK}/none.hdr)
file(WRITE ${WORK}/broken.hdr "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\nabc")
expect(3 "broken.hdr: " ${asked} --environment ${WORK}/broken.hdr)
string(REPEAT "abcd" 9 texels)
file(WRITE ${WORK}/square.hdr "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 3\n${texels}")
expect(3 "square.hdr: has 3 x 3 texels .*twice as wide as high" ${asked} --environment ${WORK}/square.hdr)

# Budgets that do not hold a strip of eight rows: 64 × 8 pixels of three fragments of 16 bytes.
expect(2 "rows 0 to 7 of the picture alone take 24576 bytes, and the memory budget has room for 24560 bytes" ${asked}
  --memory-budget 24575)
expect(2 "rows 0 to 7 of the picture alone take 24576 bytes, and the memory budget has room for 0 bytes" ${asked}
  --memory-budget 1)

# Options that the method does not heed.  (option; a value, or nothing; methods that do heed it)
set(methods none sorted peel peel-seed dual-peel interleaved-skyx interleaved abuffer)
function(heeded_by option value heeding)
  foreach(method IN LISTS methods)
    if(NOT method IN_LIST heeding)
      expect(2 "${option} goes with --transparency .*, and means nothing to ${method}\n" ${asked} --transparency ${method}
        ${option} ${value})
    endif()
  endforeach()
endfunction()
heeded_by(--layers 2 "peel;peel-seed;dual-peel")
heeded_by(--memory-budget 1M "interleaved;abuffer")
heeded_by(--min-transmittance 0.01 "peel;interleaved;abuffer")
heeded_by(--seed-composite "" peel-seed)
heeded_by(--skyx-alpha-gain "" interleaved-skyx)
heeded_by(--audit "" "peel;abuffer")
expect(2 "--layers goes with --transparency peel, peel-seed or dual-peel, and means nothing to abuffer .auto." ${asked}
  --layers 2)
expect(2 "--audit composites every fragment, so --min-transmittance ends no pixel" ${asked} --audit
  --min-transmittance 0.01)

# Shadows: a size that cannot be, and one that nothing heeds.
expect(2 "--shadow-size goes with --shadows map" ${asked} --shadow-size 512)
expect(2 "--shadow-size goes with --shadows map" ${asked} --shadows none --shadow-size 512)
expect(2 "--shadows: Check raytraced value in" ${asked} --shadows raytraced)
foreach(side 0 15 99999)
  expect(2 "a shadow map.s size is ${side}; each side must be 16 to [0-9]+ texels on" ${asked} --shadows map
    --shadow-size ${side})
endforeach()
expect(2 "--shadow-size" ${asked} --shadows map --shadow-size x)

# The reference renderer draws on no device, and by no method.
foreach(option "--device=0" "--gbuffer=classic" "--lighting=loop" "--shading=fragment" --exact --validate
    "--aov=depth=${WORK}/none.png" --gl-spirv "--pipeline-cache=${WORK}/cache" "--frames=2" "--layers=2"
    "--shadow-size=64" "--memory-budget=1M" "--min-transmittance=0.1" --seed-composite --skyx-alpha-gain --audit)
  string(REGEX REPLACE "=.*" "" name "${option}")
  run(2 "${name} is about drawing on a device, and --reference draws on the CPU: leave it out" ${asked} --reference
    ${option})
endforeach()
expect(2 "--backend is about drawing on a device" ${asked} --reference)
run(2 "of --transparency it takes auto and none, not peel" ${asked} --reference ${peel})
run(2 "--reference draws nothing on a device that --compare reference could judge" ${asked} --reference
  --compare reference)
if(BACKEND STREQUAL "vulkan")
  expect(2 "--gl-spirv goes with --backend opengl" ${asked} --gl-spirv)
else()
  # What a driver lacks is status 4.  Mesa can be told to lack it; other drivers do not listen.
  set(ENV{MESA_EXTENSION_OVERRIDE} -GL_ARB_gl_spirv)
  if(devices MATCHES "opengl 0: [^\n]*Mesa")
    expect(4 "lacks GL_ARB_gl_spirv, which gl_spirv asks for" ${asked} --gl-spirv)
  endif()
endif()

# Mesa's CPU drivers end a shader after 65535 turns of its loops, so the default cannot sort 6000 layers there: status 4,
# and no other method draws in its place.
if(devices MATCHES "${BACKEND} 0: llvmpipe")
  set(nodes)
  set(numbers)
  foreach(i RANGE 5999)
    string(APPEND nodes ",{\"mesh\":0,\"translation\":[0,0,-${i}e-4]}")
    string(APPEND numbers ",${i}")
  endforeach()
  string(REGEX REPLACE "^," "" nodes "${nodes}")
  string(REGEX REPLACE "^," "" numbers "${numbers}")
  # A triangle from (-1, -1, 0) over (1, -1, 0) to (0, 1, 0).
  set(corners AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA)
  file(WRITE ${WORK}/deep.gltf "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[${numbers}]}],
    \"nodes\":[${nodes}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],
    \"materials\":[{\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0,0,0.01]},
    \"extensions\":{\"KHR_materials_unlit\":{}}}],\"extensionsUsed\":[\"KHR_materials_unlit\"],
    \"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[-1,-1,0],
    \"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],
    \"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,${corners}\"}]}")
  expect(4 "has 6000 translucent fragments, and llvmpipe.* ends shaders after 65535 turns .*: use the method 'peel', or"
    ${WORK}/deep.gltf --size 8x8 ${none})
endif()
