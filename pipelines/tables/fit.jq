# One row of a table of fits: jq -r --arg fit F --arg value V, over the statistics of brdf-fit.
# The error is the mean over entries; materials that share another's count once.
[.materials[] | select(.shares_with == "" and .entries > 0)] as $own |
[$fit, $value, .seconds,
 ($own | map(.held_out_error * .entries) | add) / ($own | map(.entries) | add)]
| map(tostring) | join(",")
