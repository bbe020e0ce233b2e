# The table with all that was measured, from table.jq.
["case", "row", "set", "method", "status", "verdict", "unbiased", "finite", "bounded", "harmless",
 "cost_ratio", "cost_error", "tiles", "beyond3", "allowed3", "image_z", "mean_ratio", "relmse",
 "invalid", "path_length", "copies", "memory_mb", "cpu_seconds", "reason"] as $columns
| $columns, (.[] as $row | [$columns[] | $row[.] // ""]) | @csv
