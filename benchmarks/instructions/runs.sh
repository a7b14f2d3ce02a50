# The four small runs whose instructions are counted. Sourced by gate and check; defines counts.

# counts PROGRAM FOLDER: "NAME COUNT" of each, of ten steps under valgrind's callgrind; FOLDER is for what
# the runs write.
counts() {
  export GOMP_SPINCOUNT=10000 # else the program starts itself anew and valgrind loses it
  for method in sph fvm; do
    count "$1" "$2" "$method-plain" $method swinging-cube-elastic-hex --set time.integrator=ssp-rk3 \
      --set scheme.face_correction=0 --set sph.kappa=1.2
    count "$1" "$2" "$method-branch-corrected" $method swinging-cube-ve2-hex --set scheme.face_correction=1/6 \
      --set sph.kappa=1
  done
}

# count PROGRAM FOLDER NAME METHOD CASE OPTIONS...
count() {
  program=$1 folder=$2 name=$3 which=$4 case=$5
  shift 5
  valgrind --tool=callgrind --callgrind-out-file="$folder/out" --toggle-collect='*BodySolver*::step*' \
    "$program" run "$case" --method "$which" --level 1 --quiet --no-fields --threads 1 \
    --set time.max_steps=10 --set time.cfl=0.5 "$@" --out "$folder/$name" >"$folder/log" 2>&1 || {
    cat "$folder/log" >&2
    exit 4
  }
  if ! grep -q '"instruction_set": "x86-64-v3"' "$folder/$name/$which/summary.json"; then
    echo "this processor has no AVX2; the recorded counts are of AVX2" >&2
    exit 4
  fi
  echo "$name $(sed -n 's/^totals: //p' "$folder/out")"
}
