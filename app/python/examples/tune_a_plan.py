"""Tunes a plan and plots its coverage: tries how large objects shall be in the image, keeps the best
plan, says what became of the objects that it misses, and draws what smaller budgets would capture.

Usage: tune_a_plan.py room.glb best.dolly coverage.png
"""
import sys

import dollytrack as dt

room, project, picture = sys.argv[1:]
scene = dt.load(room)
plans = {fill: scene.plan(fill=fill, max_frames=100) for fill in (0.5, 0.6, 0.72)}
for fill, plan in plans.items():
    print(f"fill {fill:.2f}: {plan.metrics['well_captured_rate']:6.1%} captured well in {len(plan)} frames")
best = max(plans.values(), key=lambda plan: plan.metrics["well_captured_rate"])

for row in best.ledger:
    if not row["captured"]:
        remedy = best.explain(row["id"]).get("remedy", {"text": "nothing"})
        print(f"{row['object']}: {row['reason']}; what would help: {remedy['text']}")

curve = best.coverage(picture)["frames"]
for frames, rate in zip(curve["frames"], curve["capture_rate"]):
    print(f"{frames:4.0f} frames capture {rate:.1%}")
best.save(project)
