# What pellucid-render says and writes about transparency, on scenes whose layers are known.
#   cmake -DTOOL= -DGENERATE= -DBACKEND= -DWORK= -P transparency.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/expect.cmake)
if(no_device)
  return()
endif()
make_scene(sheets)               # three over all of the picture: from the front, alpha 1/4, 1/2 and 1/2
make_scene(intersecting_planes)  # three that cut each other
set(stats ${WORK}/stats.json)
set(all ${sheets} --size 64x48 --stats ${stats})

# known(<method> <exact> <why>): the fields that every method has, with the values that this scene makes known
function(known method exact why)
  field(${stats} ${method} settings transparency)
  field(${stats} ${method} translucency method)
  field(${stats} "${why}" translucency why)
  field(${stats} ${exact} translucency exact)
  field(${stats} 3 translucency layers max)
  field(${stats} 3.0 translucency layers mean)
  field(${stats} 3072 translucency layers covered_pixels)
  foreach(bin 0 1 2)
    field(${stats} 0 translucency layers histogram ${bin})
  endforeach()
  field(${stats} 3072 translucency layers histogram 3)
  field(${stats} 9216 translucency fragments)
endfunction()

# Exact methods, audited.
expect(0 "audit: 0 of 3072 pixels composited another number" ${all} --audit)
known(abuffer ON "auto: abuffer is exact for every scene")
field(${stats} "" translucency loses)
field(${stats} 1 translucency abuffer bands)
field(${stats} 262144 translucency abuffer pool_bytes)  # 2^14 fragments of 16 bytes
field(${stats} "" translucency abuffer memory_budget)
field(${stats} 3072 translucency audit pixels)
field(${stats} 0 translucency audit different)
expect(0 "transparency abuffer" ${all} --memory-budget 24K)
known(abuffer ON "auto: abuffer is exact for every scene")
field(${stats} 6 translucency abuffer bands)  # of eight rows, 64 × 8 × 3 × 16 bytes
field(${stats} 24576 translucency abuffer memory_budget)
expect(0 "audit: 0 of 3072 pixels" ${all} --transparency peel --audit --compare reference --error-budget 0.0005)
known(peel ON "--transparency peel")
field(${stats} 3 translucency peel layers)
field(${stats} OFF translucency peel truncated)
field(${stats} 0.0 translucency peel transmittance_left)
field(${stats} reference comparison with)
field(${stats} ON comparison within_budget)
field(${stats} 3072 comparison absolute pixels)
field(${stats} 0 comparison layers different)
field(${stats} 0 comparison coverage unstable_pixels)

# What is left out is said, with its bound: behind two sheets 3/4 × 1/2 of the light gets through.
set(bound "what was left out of a pixel is worth at most 0.375 times the largest radiance behind it")
expect(0 "warning: peel stopped at --layers, and may have lost layers behind the first 2: ${bound}" ${all}
  --transparency peel --layers 2)
known(peel OFF "--transparency peel")
field(${stats} "layers behind the first 2" translucency loses)
field(${stats} 2 translucency peel layers)
field(${stats} 2 translucency peel max_layers)
field(${stats} ON translucency peel truncated)
field(${stats} 0.375 translucency peel transmittance_left)
field(${stats} "${bound}" translucency peel error_bound)
expect(0 "transparency peel," ${all} --transparency peel --min-transmittance 0.5)
known(peel OFF "--transparency peel")
field(${stats} 0.5 translucency peel min_transmittance)
field(${stats} 0.375 translucency peel transmittance_left)
expect(0 "warning: dual-peel stopped at --layers, .*between the first 1 and the last 1" ${all} --transparency dual-peel
  --layers 1)
known(dual-peel OFF "--transparency dual-peel")
field(${stats} 1 translucency dual-peel passes)
field(${stats} ON translucency dual-peel truncated)
expect(0 "transparency peel-seed" ${all} --transparency peel-seed --layers 3 --seed-composite)
known(peel-seed OFF "--transparency peel-seed")
field(${stats} 3 translucency peel-seed layers)
field(${stats} ON translucency peel-seed seed_composite)

# Sorting is exact where nothing overlaps, and says where something does.
expect(0 "transparency sorted" ${all} --transparency sorted --compare reference --error-budget 0.002)
known(sorted ON "--transparency sorted")
field(${stats} 0 translucency sorted conflicts pairs)
expect(0 "warning: object sorting cannot be exact here" ${intersecting_planes} --size 64x64 --stats ${stats}
  --transparency sorted)
field(${stats} OFF translucency exact)
field(${stats} 3 translucency sorted conflicts pairs)
field(${stats} 1 translucency sorted conflicts pairs_listed 0 0)  # the opaque cube is instance 0

# Without transparency there is nothing to count.
expect(0 "transparency none" ${all} --transparency none)
field(${stats} OFF translucency exact)
field(${stats} "every translucent surface" translucency loses)
field(${stats} 0 translucency fragments)

# Flags of the methods that are kept to be measured change what they are about.
set(skyx ${sheets} --size 64x48 --transparency interleaved-skyx)
expect(0 "transparency interleaved-skyx" ${skyx} --out ${WORK}/plain.exr)
expect(0 "transparency interleaved-skyx" ${skyx} --out ${WORK}/gain.exr --skyx-alpha-gain --stats ${stats})
known(interleaved-skyx OFF "--transparency interleaved-skyx")
field(${stats} ON translucency interleaved-skyx skyx_alpha_gain)
file(SHA256 ${WORK}/plain.exr plain)
file(SHA256 ${WORK}/gain.exr gain)
if(plain STREQUAL gain)
  message(SEND_ERROR "--skyx-alpha-gain changes nothing")
endif()
set(seed ${sheets} --size 64x48 --transparency peel-seed)
expect(0 "transparency peel-seed" ${seed} --out ${WORK}/seed.pfm)
expect(6 "is not within the error budget 0.001" ${seed} --seed-composite --compare ${WORK}/seed.pfm
  --error-budget 0.001)
